#pragma once
/// ContactOrdering: where something new enters in this step (Section 6.2).

#include <cstdint>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// A disturbance is followed for so many steps after the last sign of it.
inline constexpr std::int16_t kFollowed = 10;

/// So many refusals in a row make a collection wait the longest, for 32 steps (unmerge.cpp).
inline constexpr std::int8_t kMostRefusals = 5;

/// A member that meets something, or that sweeps have changed much: it counts for kFollowed steps.
void jolt(State& state, BodyId b);

/// Whether what has come in lately has jolted a good part of the collection: a quarter.
bool isJolted(const State& state, const Collection& c);

/// ContactOrdering: the bodies at which something is new: a fresh contact that closes in this step,
/// or an impulse; and the collections that they belong to. A collection whose frame's acceleration
/// jumps is disturbed as a whole.
void orderContacts(State& state, Scratch& scratch);

/// What a collection feels, those that touch it feel in the same step.
void spreadDisturbance(const State& state, Scratch& scratch);

}  // namespace merge2d
