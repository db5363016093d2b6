#pragma once
/// No number that is not finite leaves a stage unnoticed.

#include <functional>
#include <string>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Throws SimulationError naming body, stage and step when what the stage computed is not finite:
/// the velocities of SingleIterationPGS and SolveLCP, and with them their impulses; velocities and
/// positions after AdvanceVelocities and AdvancePositions. Of other stages nothing is asked.
void checkFinite(const State& state, const Scratch& scratch, Stage stage,
                 const std::function<std::string(BodyId)>& nameOf);

}  // namespace merge2d
