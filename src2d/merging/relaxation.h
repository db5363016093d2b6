#pragma once
/// The engine's own block sweeps inside the conjugate gradient (dynamics/nncg.h), over the rows
/// inside one collection, until they have converged.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The largest change that one more solve of a row inside would make [m/s], with the velocities
/// `u` of its members and of its frame, seen from the frame.
double residualInside(const Collection& collection, const std::vector<SolverVelocity>& u);

/// Solves the rows inside, with the velocities in `scratch.trial_u`, until their residual is
/// below `tolerance` [m/s] or the sweeps of a step are spent (DecidedSettings); returns it [m/s].
/// Where a search is under way it goes on as if there had been no pause.
double relax(const State& state, Scratch& scratch, Collection& collection, double tolerance);

}  // namespace merge2d
