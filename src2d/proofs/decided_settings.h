#pragma once
/// The table of the default rule.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The numbers of the default rule, with the experiments that chose them.
struct DecidedSettings {
  /// A pair merges once the impulse between its bodies changes by less than so many times itself in
  /// a second [1/s].
  /// Without, walls merge while all still sinks in, and bricks rock at their top later: a wall of
  /// 5,000 on a swinging platform takes hundreds of times as long on average, and the wagon's books
  /// part twice as often. With 1 `bench/tilts` has 5 late walls of 80 instead of 2.
  double settling_rate = 2.0;
  /// Bodies of a weld that gain velocity against each other faster than this part under the gravity
  /// of the earth [m/s²], and in proportion under another: a two-thousandth of it. In a world
  /// without weight as under 1 m/s². A see-saw that is 0.7 mm out of balance gains 0.008.
  double cut_acceleration = 0.005;
  /// In a step in which something hits, a slip may go on that friction ends within this way [m]: of
  /// a weld with friction 0.6 one of 5 mm/s. Without, rain on a wall of 5,000 takes six times as
  /// long.
  double slip_in_hit = 2.124e-6;
  /// A search has converged where the largest row residual is below this part of the cut speed [1].
  /// A weld must also move by more than the residual at the box where it moves least: a long body
  /// beside a short one makes much of the rotation that a residual leaves (ship-crane). While a
  /// search goes on that has found no motion yet, the residual must be below this part of the
  /// motion of some weld: where it need only be smaller, a wall on a swinging platform loses
  /// bricks.
  double tolerance = 0.1;
  /// Row sweeps of a search per step; it goes on in the next one. However many rows there are, it
  /// may take as many sweeps as the full solve.
  double row_sweeps = 1e4;
  /// Times as many where a search has found motion: without, a wall of 5,000 that swings takes
  /// three times as long on average.
  double when_open = 4.0;
  /// The time after which a search, or hits without a break, are long [s].
  /// * A long search: the direct solver takes part, with the load of the step, in steps of the
  ///   search that are powers of two, where all rows are swept. After 0.64 s a wall of 1,000 bricks
  ///   on a swinging platform costs more than its reference; after 0.16 s a wall slips late.
  /// * A collection that is hit for long steps back, as its bodies cost less one by one. A tower of
  ///   20,000 that is struck loses as many bricks as the reference; with 0.2 s 3% fewer.
  double lasting = 0.08;
  /// A carried load is followed by one this part further from the mean of the witnesses [1]: a wall
  /// on a swinging platform then needs one search, not one per new extreme.
  double overshoot = 0.5;
  /// A load is covered where the witnesses leave this part of the frame's motion over, and of the
  /// forces from outside. These weigh less, as they act on one member each [1].
  double left_over = 0.9e-3, outer_weight = 0.05;
  /// The most sweeps of a search in one step, and the steps after which an event is past.
  /// * Sweeps: more of them settle a load that the next step replaces.
  /// * A hit: until then a collection is looked at once in as many steps as a pair must be quiet
  ///   for before it merges, as a heap into which bodies fall changes before a search could end.
  ///   The filling funnel and the collapsing tower-platform take three quarters of the time.
  /// * The motion of a pair that parted slowly: it waits as long as it would still seem at rest, at
  ///   most so many steps, unless it is found to gain less by then.
  /// * A search: the memory of its rows is given back, though not at once, as loads come again.
  int patience = 200;
  /// One in so many is a small part of a collection: it keeps its layout while no larger part of it
  /// has come in, and its proofs while no larger part of its members is loaded from outside; and an
  /// open region that leaves no larger part outside takes all.
  std::size_t little = 8;
};
inline constexpr DecidedSettings kDecided;

/// So many are a small part of a collection.
inline bool isSmallPart(std::size_t part, std::size_t of) { return kDecided.little * part <= of; }

/// Steps from a hit or an impulse on in which a collection is open: as many as a pair must be quiet
/// for before it merges.
inline int hitSteps(const State& state) { return state.settings.merging.steps; }

/// Pairs that meet faster than this are an impact: gravity alone does not do it within two steps,
/// so a resting body that lost its contact for a moment is none [m/s].
inline double impactSpeed(const State& state) {
  return std::max(2.0 * state.h * state.gravity.norm(), state.settings.unmerging.velocity);
}

/// Something has hit the collection in the last `hitSteps` steps.
inline bool isHit(const State& state, const Collection& c) {
  return state.step - c.hits.blow < hitSteps(state);
}

/// Row sweeps of a step over so many rows.
inline double rowSweeps(const State& state, std::size_t rows) {
  return std::max(kDecided.row_sweeps,
                  state.settings.solver.iterations * static_cast<double>(rows));
}

/// The full solve spends more row sweeps on its contacts than a search may in one step: then a
/// hit is followed only as far as it reaches.
inline bool isLarge(const State& state, const Collection& c) {
  return rowSweeps(state, c.block_contact.size()) > kDecided.row_sweeps;
}

/// A hit opens but a region of it (open_region.h).
inline bool opensInPart(const State& state, const Collection& c) {
  return isLarge(state, c) && !state[c.rigid].floating() && c.joints.empty();
}

/// The speed at which bodies of a collection part [m/s].
inline double cutSpeed(const State& state) {
  constexpr double kEarth = 9.81;
  const double gravity = state.gravity.norm();
  return kDecided.cut_acceleration * ((gravity > 0.0 ? gravity : 1.0) / kEarth) * state.h;
}

/// The speed at which the bodies of a weld part [m/s].
inline double cutSpeed(const State& state, const Collection& c, const Weld& weld) {
  if (!isHit(state, c)) return cutSpeed(state);
  const double friction = frictionOf(state, weld.a, weld.b);
  const double slip = std::sqrt(2.0 * friction * state.gravity.norm() * kDecided.slip_in_hit);
  return std::max(slip, cutSpeed(state));
}

/// Whether what goes on for so many steps lasts.
inline bool lasts(const State& state, std::int64_t steps) {
  constexpr double kRounding = 1.0 - 1e-9;
  return static_cast<double>(steps) * state.h >= kRounding * kDecided.lasting;
}

/// Steps after which a pair no longer seems at rest that parts with this gain per step [m/s].
inline double stepsUntilSeen(const State& state, double gain) {
  return std::min<double>(kDecided.patience, state.settings.merging.velocity / gain);
}

/// Below this residual a search has converged [m/s].
inline double toleratedResidual(const State& state) { return kDecided.tolerance * cutSpeed(state); }

}  // namespace merge2d
