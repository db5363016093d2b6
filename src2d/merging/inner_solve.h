#pragma once
/// The solve of the contacts inside collections until they have converged: the engine's own block
/// sweeps inside the conjugate gradient (dynamics/nncg.h), over rigid rows inside, joints, and the
/// soft rows of the contacts around them.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The numbers of `unmerging.rule = "decided"`, each with the experiment that chose it.
struct DecidedSettings {
  /// Bodies of a weld that gain velocity against each other faster than this part [m/s²]: a
  /// five-hundredth of gravity. `bench/carts` and `bench/tilts` change little between 0.005 and
  /// 0.05.
  double cut_acceleration = 0.02;
  /// A solve has converged where the largest row residual is below this part of the cut speed [1].
  double tolerance = 0.1;
  /// A weld must also move this many residuals at the box where it moves least: a long body beside
  /// a short one makes much of the rotation that a residual leaves (ship-crane) [1].
  double beyond_residual = 3.0;
  /// Sweeps per step, and how many row sweeps: a search goes on in the next step.
  int most_sweeps = 200, least_sweeps = 20;
  double row_sweeps = 4e4;
  /// A carried load is followed by one this part further from the mean of the witnesses [1]: a wall
  /// on a swinging platform then needs one search, not one per new extreme.
  double overshoot = 0.5;
  /// Steps after a touch or a hit in which the refined sweep decides (refined_sweep.h).
  int blow_steps = 10;
};
inline constexpr DecidedSettings kDecided;

/// The speed at which bodies of a weld part [m/s].
double cutSpeed(const State& state);

/// Solves, for each set of doubted collections that act on each other, the contacts inside and
/// around them (`Doubt::Load`). Leaves the largest row residual in Collection::residual and says in
/// the certificate whether the search goes on.
void solveDoubted(State& state, Scratch& scratch);

/// Whether the contacts inside carry a load: the members are solved about the frame at rest, where
/// the heaviest one of a floating collection is fixed, as its rows follow from those of the others.
/// Blocks and joints then hold the impulses.
bool carries(const State& state, Scratch& scratch, Collection& collection, const Witness& load);

}  // namespace merge2d
