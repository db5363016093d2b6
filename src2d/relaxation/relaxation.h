#pragma once
/// The rows inside one collection, solved until they have converged (block_sweeps.h).

#include "src2d/dynamics/state.h"
#include "src2d/relaxation/sweep_budget.h"

namespace merge2d {

/// Solves the rows inside, with the velocities in SweepMemory::trial_u, until their residual is
/// below `tolerance` [m/s] or the budget is spent; returns it [m/s]. The sweeps over all rows of a
/// search go on as if there had been no pause. `search` is null where none goes on here.
double relax(const State& state, const SweepTools& tools, Collection& collection, double tolerance,
             SweepBudget budget, ProofSearch* search);

/// Goes on, after the full solve, with the contacts inside an open collection until they have
/// converged, or for as many sweeps as a step may spend; forces from outside stay as they are. A
/// hit is followed as far as it moves anything: the members that it reaches join the region. Leaves
/// the region's velocities, seen from the collection, in the caller's SweepMemory::trial_u, and
/// the largest residual of a row in Collection::residual.
void relaxOpen(State& state, Scratch& scratch, OpenRegion& region);

}  // namespace merge2d
