#pragma once
/// The table of the default rule.

#include <algorithm>
#include <cmath>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The numbers of the default rule, with the experiments that chose them.
struct DecidedSettings {
  /// Bodies of a weld that gain velocity against each other faster than this part [m/s²]: a
  /// two-thousandth of gravity. A see-saw that is 0.7 mm out of balance gains 0.008.
  double cut_acceleration = 0.005;
  /// In a step in which something hits, a slip may go on that friction ends within this way [m]: of
  /// a weld with friction 0.6 one of 5 mm/s. Without,
  /// rain on a wall of 5,000 takes six times as long.
  double slip_in_hit = 2.124e-6;
  /// A search has converged where the largest row residual is below this part of the cut speed [1].
  double tolerance = 0.1;
  /// A weld must also move by more than the residual at the box where it moves least: a long body
  /// beside a short one makes much of the rotation that a residual leaves (ship-crane). While a
  /// search goes on that has found no motion yet, some weld must move by this many residuals: with
  /// 1 a wall on a swinging platform loses bricks [1].
  double sure = 3.0;
  /// Sweeps per step, and how many row sweeps: a search goes on in the next step. It begins with
  /// few and doubles them from step to step, as many loads do not last: the collapsing
  /// tower-platform then takes half as many.
  double row_sweeps = 1e4, first_row_sweeps = 500.0;
  int most_sweeps = 200, full_sweeps = 10;  ///< and at last as many, of however many rows
  /// Times as many where a search has found motion: without, a wall of 5,000 that swings takes
  /// three times as long on average.
  double when_open = 4.0;
  /// After so many steps of a search, a power of two, and after each twice as many, the direct
  /// solver takes part, with the load of that step. With 64 a wall of 1,000 bricks on a swinging
  /// platform costs more than its reference; with 8 `bench/tilts` falls a little later.
  int direct_from = 8;
  /// A carried load is followed by one this part further from the mean of the witnesses [1]: a wall
  /// on a swinging platform then needs one search, not one per new extreme.
  double overshoot = 0.5;
  /// A load is covered where the witnesses leave this part of the frame's motion over, and this
  /// part of the forces from outside [1]. Forces from outside weigh less, as they act on one member
  /// each [1].
  double left_of_frame = 0.9e-3, left_of_outer = 3e-2, outer_weight = 0.05;
  double left_of_rest = 2e-6;  ///< and where so little is left over of any load [m/s]
  /// Steps from a hit or an impulse on in which the collection is open.
  int hit_steps = 3;
  /// A collection that is hit for so long without a break of `hit_steps` [s] steps back: its bodies
  /// cost less one by one. A tower of 20,000 that buckles takes two thirds of the time, and a
  /// struck one loses as many bricks as the reference; with 0.2 s 3% fewer.
  double hit_time = 0.08;
  /// Steps after which something is past. A hit: until then a collection is looked at once in as
  /// many steps as a pair must be quiet for before it merges, as a heap into which bodies fall
  /// changes before a search could end; the filling funnel and the collapsing tower-platform take
  /// three quarters of the time. And a search: the memory of its rows is given back, though not at
  /// once, as loads come again.
  int past_steps = 100;
  /// A pair whose weld broke sooner after it had formed waits for the rest of these steps before it
  /// may merge again, or it would merge and part in turn while it barely moves. One that moved
  /// slowly waits as long as it would still seem at rest, at most so many steps, unless it is found
  /// to gain less by then.
  int flicker_steps = 20, longest_wait = 200;
};
inline constexpr DecidedSettings kDecided;

/// Something hits it in these steps.
inline bool isHit(const State& state, const Collection& c) {
  return state.step - c.hits.blow < kDecided.hit_steps;
}

/// Ten sweeps over all its rows are more than those of a step: a hit is followed only as far as it
/// reaches.
inline bool isLarge(const Collection& c) {
  return kDecided.full_sweeps * static_cast<double>(c.block_contact.size()) > kDecided.row_sweeps;
}

/// A hit opens but a region of it (open_region.h).
inline bool opensInPart(const State& state, const Collection& c) {
  return isLarge(c) && !state[c.rigid].floating() && c.joints.empty();
}

/// The speed at which bodies of a collection part [m/s].
inline double cutSpeed(const State& state) { return kDecided.cut_acceleration * state.h; }

/// The speed at which the bodies of a weld part [m/s].
inline double cutSpeed(const State& state, const Collection& c, const Weld& weld) {
  if (!isHit(state, c)) return cutSpeed(state);
  const double friction = frictionOf(state, weld.a, weld.b);
  const double slip = std::sqrt(2.0 * friction * state.gravity.norm() * kDecided.slip_in_hit);
  return std::max(slip, cutSpeed(state));
}

/// Steps after which a pair no longer seems at rest that parts with this gain per step [m/s].
inline double stepsUntilSeen(const State& state, double gain) {
  return std::min<double>(kDecided.longest_wait, state.settings.merging.velocity / gain);
}

/// Below this residual a search has converged [m/s].
inline double toleratedResidual(const State& state) {
  return kDecided.tolerance * kDecided.cut_acceleration * state.h;
}

}  // namespace merge2d
