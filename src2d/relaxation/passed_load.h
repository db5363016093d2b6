#pragma once
/// A load that is new on few members, such as the weight of a body that came to lie on them.

#include "src2d/dynamics/state.h"
#include "src2d/proofs/collection_load.h"

namespace merge2d {

/// Passes on the part of a load that the impulses inside leave (load_path.h), and keeps the proof:
/// the members rest one by one, so that no search is needed. False where contacts on that way
/// cannot carry it; the impulses are then as before. The blocks must be there.
bool passesOn(const State& state, const Scratch& scratch, Collection& c,
              const CollectionLoad& load);

}  // namespace merge2d
