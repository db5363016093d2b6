#pragma once
/// A body that has slept for a few steps is parked: it leaves all lists that the stages go through,
/// so that the cost of a step does not depend on how many sleep.
///
/// No result depends on it. A set of rigid things that touch, or that joints hold together, is
/// parked as a whole, and comes back as a whole before something acts on one of them. Nothing in
/// such a set is awake, carries a load, or is held by a body that moves. Parked things keep their
/// leaves in the broadphase, where those that move find them.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Steps for which a rigid thing must have slept.
inline constexpr int kStepsUntilParked = 4;

/// Parks the bodies that have slept for long enough. To be called between two steps.
void parkSleepers(State& state, Scratch& scratch);

/// Brings back, still asleep, the rigid things of some bodies and all that touches them: around a
/// body that is never parked those that are near it.
void bringBackAround(State& state, Scratch& scratch, const std::vector<BodyId>& bodies);

/// Brings back all of them, for whoever looks at the lists.
void bringAllBack(State& state, Scratch& scratch);

/// Brings back the bodies that something acts on in this step: impulses, loads, or a user's change.
void bringBackActedOn(State& state, const Scratch& scratch);

/// Brings back all that is touched by something that is not parked.
void bringBackTouched(State& state);

}  // namespace merge2d
