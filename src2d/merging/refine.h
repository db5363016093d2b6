#pragma once
/// A local refinement of the single sweep: where something new has entered, sweeps go on as long
/// and as far as they still change velocities. Deviation from the single sweep of Section 6.2,
/// which leaves a blow near where it fell. Guarded by Refine.CarriesABlowAsFarAsItGoes.

#include <cstdint>
#include <span>
#include <vector>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The rows that a refinement may sweep, and how often.
struct SweepScope {
  std::vector<SweepItem> loose;          ///< contacts outside collections, and all joints
  std::span<const std::uint8_t> inside;  ///< per collection slot: its contacts too
  int most = 0;                          ///< sweeps to spend
};

/// Solves one block of rows, whose `normal` is given in the frame of the velocities.
inline void sweepBlock(ContactBlock& k, const Vec2& normal, std::vector<SolverVelocity>& u,
                       SolverMethod method) {
  if (method == SolverMethod::Pgs) {
    solveRows(k, normal.x(), normal.y(), u[k.a], u[k.b]);
  } else {
    solveBlock(k, normal.x(), normal.y(), u[k.a], u[k.b]);
  }
}

/// The same, where the block's frame is turned by `turn`.
inline void sweepBlock(ContactBlock& k, const Rotation& turn, std::vector<SolverVelocity>& u,
                       SolverMethod method) {
  sweepBlock(k, turn * Vec2(k.nx, k.ny), u, method);
}

inline void sweepItem(const SweepItem& item, std::vector<SolverVelocity>& u, SolverMethod method) {
  if (item.block) return sweepBlock(*item.block, item.normal(), u, method);
  solveJoint(*item.joint, item.turn, u[item.joint->a], u[item.joint->b]);
}

/// Velocities below this may be left by one sweep for the next: a thousandth of the velocity that
/// gravity adds in a step [m/s].
double residualVelocity(const State& state);

/// A sweep that changes a member's velocity by more than this is to be followed by others: a tenth
/// of the slip that parts a weld [m/s].
double refinedVelocity(const State& state);

/// Sweeps the rows at the seeds and at the bodies marked in `scratch.restless_bodies`, breadth
/// first; then those at bodies that the last sweep changed by more than `threshold` [m/s], and so
/// on, accelerated as in the full solve, until there are none or `scope.most` sweeps are spent.
/// Returns the largest change that may be left [m/s].
double sweepUntilQuiet(State& state, Scratch& scratch, const SweepScope& scope,
                       std::span<const std::uint32_t> seeds, double threshold);

}  // namespace merge2d
