#pragma once
/// SleepAndWake (Section 7). The rule decides which things sleep and wake together (rule.h).

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The stage: nothing happens in a mode without sleeping.
void sleepAndWake(State& state, Scratch& scratch);

}  // namespace merge2d
