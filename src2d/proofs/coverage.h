#pragma once
/// Whether the proofs of a collection cover a load (load_certificate.h).

#include "src2d/proofs/collection_load.h"

namespace merge2d {

/// The combination of the loads that were carried which is nearest to a load.
struct Coverage {
  /// "proof": how much of the load it leaves over; where that is little, but members move faster
  /// under its impulses than welds are cut, "proof-motion" [m/s].
  Criterion carried;
  LoadCertificate::Weights weights{};
};
Coverage coverageOf(const State& state, const Collection& c, const CollectionLoad& load);

/// True when the latest proof carries this load but for the forces from outside.
bool isNewOutsideAlone(const State& state, const Collection& c, const CollectionLoad& load);

/// True while a load is nearer to the one that is sought ahead than where that search began.
bool leadsTo(const State& state, const Collection& c, const CollectionLoad& load);

}  // namespace merge2d
