#pragma once
/// The velocities with which the full solve begins.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Fills `scratch.u` with u₋ + h M⁻¹ f for everything in B and the members of open collections;
/// a fixed or sleeping body keeps its velocity, and does not respond.
void startVelocities(const State& state, Scratch& scratch);

}  // namespace merge2d
