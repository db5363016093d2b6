#pragma once
/// Falling asleep and waking, for islands and for each rigid thing (Section 7). Which things do so
/// together is a matter of the rule.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Per island of rigid things that touch. Deviation: the paper lets each body of B sleep by itself.
/// Here an island sleeps when all of it is at rest and the forces inside its collections have
/// settled, and wakes as a whole: a sleeper is never left hanging when its support wakes. Guarded
/// by tests/src2d/sleeping/sleep_test.cpp.
void sleepByIslands(State& state, Scratch& scratch);

/// True for a rigid thing that the stage may put to sleep: it floats, or is a collection.
bool canSleep(const State& state, RigidId id);

/// Marks in `scratch.restless` the rigid things that something from outside keeps awake or wakes:
/// impulses, changed loads, moving scripted bodies.
void markRestless(State& state, Scratch& scratch);

/// Puts one rigid thing to sleep.
void fallAsleep(State& state, Scratch& scratch, RigidId id);

/// A rigid thing has been quiet for long enough, or sleeps, and nothing disturbs it (Section 7).
Criterion isQuiet(const State& state, const Scratch& scratch, RigidId id);

/// Records the test that decided whether a rigid thing sleeps, where it holds, or stays awake.
void recordSleep(const State& state, const Scratch& scratch, RigidId id, const Criterion& test);

/// Wakes one rigid thing; its island follows in the stage.
void wakeUp(State& state, Scratch& scratch, RigidId id);

}  // namespace merge2d
