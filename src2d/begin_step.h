#pragma once
/// Changes to a world from outside, before a step begins.

#include "src2d/dynamics/forces.h"
#include "src2d/dynamics/state.h"

namespace merge2d {

/// Lets bodies appear and go, switches magnets, moves scripts, lists loads and kicks. Everything
/// that happens at a time happens in the step that begins nearest to it.
void beginStep(State& state, Actions& actions, Scratch& scratch);

/// Appends bodies, and all that they touch or are joined to.
void listAround(const State& state, const std::vector<BodyId>& bodies, std::vector<BodyId>& out);

}  // namespace merge2d
