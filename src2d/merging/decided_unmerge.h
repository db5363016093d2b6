#pragma once
/// Unmerge: where nothing moves in a search that has converged, or in the full solve with an open
/// collection, the load is remembered as carried; the welds whose bodies move in the full solve are
/// cut. Deviation from Sections 6.3 and 6.4, which decide from one sweep.
/// Guarded by tests/src2d/merging/decided_unmerge_test.cpp.

#include "src2d/collections/parts.h"
#include "src2d/dynamics/state.h"
#include "src2d/relaxation/proof_search.h"

namespace merge2d {

/// After a step of a search, with the velocities that it left in `trial_u`: where it has converged,
/// keeps its proof. False where it has found motion, or a joint that bears too much.
bool endSearch(State& state, const SearchTools& tools, Collection& collection);

/// Some joint inside bears too much with the impulses of the collection's blocks, which it takes
/// over.
bool overloadsJoints(State& state, const Collection& collection);
inline constexpr Criterion kOverloaded{"joints", kOwnDecided, 1.0, 0.0, false};

/// After the full solve with open collections.
void unmergeMovers(State& state, Scratch& scratch);

}  // namespace merge2d
