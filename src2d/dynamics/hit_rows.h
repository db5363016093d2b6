#pragma once
/// Rows of the full solve that are left to the hits (dynamics/hits.h).

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The bias of a row that takes no part in a solve [m/s].
inline constexpr double kNeverActs = 1e12;

/// A hit that comes by less than this part of its way before the end of a step belongs to the next
/// one: rounding must not decide whether bodies meet in a step [1].
inline constexpr double kEndOfStep = 1e-9;

/// Slower approaches of a pair do not bounce [m/s]: `restitution_velocity`, or for small bodies
/// the final speed of a fall by a part of their size.
double leastBounce(const State& state, const ContactKey& key);

/// The cast of a contact whose points may be left to the hits, or nullptr.
const Cast* castToHit(const State& state, const Scratch& scratch, const Contact& contact);

/// True for a point that takes no part in the full solve, as it is going to be hit: it approaches
/// with −`w_start` at the start of the step and −`w_free` with the loads of the step [m/s].
bool isHit(const State& state, const Contact& contact, const Cast* cast, double gap, double w_start,
           double w_free);

/// The velocity at the start of the step, with the impulses that are about to be given, of a body
/// that responds to forces; of any other its velocity in the step.
SolverVelocity velocityAtStart(const State& state, const Scratch& scratch, std::uint32_t rigid);

}  // namespace merge2d
