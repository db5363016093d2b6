#pragma once
/// `rule = "default"`: a weld holds while its contacts can carry the load.
///
/// A collection is a hypothesis: its members move as one. Its proof is a set of admissible impulses
/// (Eqs. (2)-(7)) that carries the load of this step without relative motion. A load that known
/// proofs cover (load_certificate.h) leaves the collection quiet. Impulses for any other load are
/// sought over as many steps as that takes (doubt.h, proof_search.h). Where a search finds motion,
/// or something hits the collection, its members take part in the full solve (open_solve.h), and
/// the welds whose bodies move are cut (decided_unmerge.h). Islands sleep and wake as a whole
/// (sleep.h).

#include "src2d/merging/rule.h"

namespace merge2d {

extern const MergingMethod kDefaultMerging;
extern const UnmergingMethod kDefaultUnmerging;

}  // namespace merge2d
