#pragma once
/// WarmStart (Section 6.2): the velocities that the single sweep starts from, and the rows around
/// collections.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The stage, which the rule of unmerging fills (rule.h).
void warmStart(State& state, Scratch& scratch);

/// For the paper's rule: sets up the velocities that the sweep starts from.
void warmStartSweep(State& state, Scratch& scratch);

}  // namespace merge2d
