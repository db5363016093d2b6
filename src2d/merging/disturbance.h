#pragma once
/// ContactOrdering: where something new enters in this step (Section 6.2).

#include <cstdint>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// A disturbance is followed for so many steps after the last sign of it.
inline constexpr std::int16_t kFollowed = 10;

/// A member that meets something, or that sweeps have changed much: it counts for kFollowed steps.
void jolt(State& state, BodyId b);

/// ContactOrdering: the bodies at which something is new: a fresh contact that closes in this step,
/// or an impulse; and the collections that they belong to. A collection whose frame's acceleration
/// jumps is disturbed as a whole.
void orderContacts(State& state, Scratch& scratch);

/// What a collection feels, those that touch it feel in the same step.
void spreadDisturbance(const State& state, Scratch& scratch);

}  // namespace merge2d
