#pragma once
/// ContactOrdering: where something new enters in this step (Section 6.2).

#include <cstdint>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Pairs that meet faster than this are an impact: gravity alone does not do it within two steps,
/// so a resting body that lost its contact for a moment is none [m/s].
double impactSpeed(const State& state);

/// A disturbance is followed for so many steps after the last sign of it.
inline constexpr std::int16_t kFollowed = 10;

/// A member that meets something is jolted, and so is one whose velocity sweeps change by more than
/// this: five times the slip that cuts a weld, half of the velocity that gravity adds in a step of
/// 0.01 s [m/s].
double joltVelocity(const State& state);

/// Notes for kFollowed steps that a body is jolted, where its velocity changes by so much, squared
/// [m²/s²].
void noteJolt(State& state, std::uint32_t body, double change);

/// Whether a quarter of the members have been jolted lately.
bool isJolted(const State& state, const Collection& c);

/// ContactOrdering: the bodies at which something is new: a fresh contact that closes in this step,
/// or an impulse; and the collections that they belong to. A collection whose frame's acceleration
/// jumps is disturbed as a whole.
void orderContacts(State& state, Scratch& scratch);

/// Collections that touch a disturbed one are disturbed in the same step.
void spreadDisturbance(const State& state, Scratch& scratch);

}  // namespace merge2d
