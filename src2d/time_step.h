#pragma once
/// The length of the time steps of a world that runs.
///
/// Forces last across a change of h, so the impulses of the last step, which start the next solve,
/// are scaled with it: λ = h f. So are all other memories of the length of a step: the gain of a
/// frame's velocity, and the number of steps for which a body has been slow. Rows inside
/// collections are made anew, and proofs that these hold are dropped: they are of loads per step.

#include "src2d/setup.h"

namespace merge2d {

/// The time after the steps taken so far [s].
double timeOf(const State& state);

/// `h` is the length of the steps to come [s]. Wakes all bodies: the overlap of a contact at rest
/// depends on it (SolverSettings::erp and compliance).
void setTimeStep(Setup& setup, double h);

}  // namespace merge2d
