#pragma once
/// How bodies outside push a collection.

#include <vector>

#include "src2d/dynamics/state.h"
#include "src2d/proofs/collection_load.h"

namespace merge2d {

/// The loads from outside, in which each free body pushes as it does as a whole, but with the
/// smallest impulses: a solve leaves friction at its contacts that works against itself, such as of
/// a box that falls flat on two bricks and would push them apart.
std::vector<OuterLoad> relievedLoads(const State& state, const Scratch& scratch,
                                     const Collection& c, const CollectionLoad& load);

}  // namespace merge2d
