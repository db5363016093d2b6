#pragma once
/// SleepAndWake (Section 7), per island of rigid things that touch.
///
/// Deviation: the paper lets each body of B sleep by itself. Here an island sleeps when all of it
/// is at rest and the forces inside its collections have settled, and wakes as a whole: a sleeper
/// is never left hanging when its support wakes. Guarded by tests/src2d/merging/sleep_test.cpp.

#include "src2d/dynamics/state.h"

namespace merge2d {

void sleepAndWake(State& state, Scratch& scratch);

/// Wakes one rigid thing; its island follows in the stage.
void wakeUp(State& state, Scratch& scratch, RigidId id);

/// True when nothing but the inner forces of collections keeps its island awake in this step.
bool awaitsInnerForces(const State& state, Scratch& scratch, RigidId id);

}  // namespace merge2d
