#pragma once
/// SingleIterationPGS (Section 6.2): the impulses inside collections. By the paper's rule one sweep
/// of PGS over the contacts inside, and those around them, keeps the inner forces alive. Its
/// velocities are only looked at, by Unmerge; its impulses of contacts outside collections are
/// thrown away, so that the full solve's warm start is untouched. The default rule searches, and
/// opens collections (doubt.h).

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Solves one block of rows, whose `normal` is given in the frame of the velocities.
inline void sweepBlock(ContactBlock& k, const Vec2& normal, std::vector<SolverVelocity>& u,
                       SolverMethod method) {
  if (method == SolverMethod::Pgs) {
    solveRows(k, normal.x(), normal.y(), u[k.a], u[k.b]);
  } else {
    solveBlock(k, normal.x(), normal.y(), u[k.a], u[k.b]);
  }
}

inline void sweepItem(const SweepItem& item, std::vector<SolverVelocity>& u, SolverMethod method) {
  if (item.block) return sweepBlock(*item.block, item.normal(), u, method);
  solveJoint(*item.joint, item.turn, u[item.joint->a], u[item.joint->b]);
}

/// Updates the impulses inside collections.
void sweepCollections(State& state, Scratch& scratch);

/// For the paper's rule: `inside` updates the impulses inside; the impulses outside that only the
/// sweep knows are kept.
void sweepAround(State& state, Scratch& scratch, void (*inside)(State& state, Scratch& scratch));

}  // namespace merge2d
