#pragma once
/// For how long each rigid thing has been at rest in the world (Section 7).

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Counts the consecutive steps in which each rigid thing could sleep. Deviation: an accelerating
/// body does not sleep, however slow it is, or a stone would stay at the top of its flight. Guarded
/// by Balance.WhatFallsSlowlyFallsOn.
void countQuietRigids(State& state, Scratch& scratch);

}  // namespace merge2d
