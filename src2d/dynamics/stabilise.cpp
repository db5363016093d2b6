#include "src2d/dynamics/stabilise.h"

#include <algorithm>
#include <span>

#include "src2d/core/grid.h"
#include "src2d/dynamics/nncg.h"

namespace merge2d {
namespace {

/// Rows ask for the velocity that closes the overlap that is left after the step; no friction.
void aimAtGaps(const State& state, Scratch& scratch) {
  for (std::size_t i = 0; i < scratch.blocks.size(); ++i) {
    ContactBlock& k = scratch.blocks[i];
    const RowSource& source = scratch.row_sources[scratch.block_order[i].source()];
    for (int p = 0; p < k.count; ++p) {
      const double w = contactVelocity(k, p, k.nx, k.ny, scratch.u[k.a], scratch.u[k.b]).n;
      const ContactPoint& point = state.contacts.point(source.points[static_cast<std::size_t>(p)]);
      const double gap = point.gap + state.h * w;
      k.bias[p] = (gap > 0.0 ? gap : kCorrectedShare * gap) / state.h;
      if (k.bilateral) k.bias[p] = std::min(k.bias[p], state.settings.solver.max_correction);
    }
    k.lambda = {};
    k.mu = 0.0;
    if (k.count == 1) k.bias[1] = 0.0;             // no resistance to rolling
    for (double& inv_kt : k.inv_kt) inv_kt = 0.0;  // also no bilateral friction
  }
}

/// The error of a joint follows from where the bodies are now. Motors and springs have done what
/// they should.
void aimAtJoints(const State& state, Scratch& scratch) {
  for (JointBlock& k : scratch.joint_blocks) {
    const Joint& joint = state.joints[k.joint];
    const Vec2 x_b = joint.to_world ? Vec2(Vec2::Zero()) : state.rigids[k.b].x;
    const JointPlace place = placeOf(state, joint, {}, state.rigids[k.a].x, x_b);
    JointBlock anew =
        makeJointBlock(state, joint, place, JointRows::Correcting, scratch.u[k.a], scratch.u[k.b]);
    anew.a = k.a;
    anew.b = k.b;
    anew.joint = k.joint;
    anew.lambda = {};
    anew.motor = false;
    if (joint.stiffness > 0.0 || joint.compliance > 0.0 || joint.broken) anew.coupled = 0;
    k = anew;
  }
}

void solve(const State& state, Scratch& scratch, const Island& island) {
  auto& u = scratch.u;
  const std::span blocks(scratch.blocks.data() + island.first, island.last - island.first);
  const std::span joints(scratch.joint_blocks.data() + island.first_joint,
                         island.last_joint - island.first_joint);
  const std::span bodies(scratch.island_bodies.data() + island.first_body,
                         island.last_body - island.first_body);
  JointSolver together(joints, u, scratch.joint_memory);
  Nncg iteration(
      blocks.size() + joints.size(),
      [&](std::size_t i) -> Impulses& {
        return i < blocks.size() ? blocks[i].lambda : joints[i - blocks.size()].lambda;
      },
      bodies.size(), [&](std::size_t i) -> SolverVelocity& { return u[bodies[i]]; },
      [&] {
        together.sweep();
        for (ContactBlock& k : blocks) solveBlock(k, k.nx, k.ny, u[k.a], u[k.b]);
      },
      scratch.sweeps.front().nncg);
  iteration.run(state.settings.solver.iterations, isAccelerated(state.settings.solver.method));
}

}  // namespace

void correctPositions(State& state, Scratch& scratch) {
  if (state.settings.solver.stabilisation != Stabilisation::Post) return;
  aimAtGaps(state, scratch);
  for (SolverVelocity& u : scratch.u) u.vx = u.vy = u.omega = 0.0;
  aimAtJoints(state, scratch);
  scratch.joint_memory.next = 0;
  for (const Island& island : scratch.islands) solve(state, scratch, island);
  for (const std::uint32_t i : scratch.island_bodies) {
    const SolverVelocity& u = scratch.u[i];
    Rigid& r = state.rigids[i];
    r.moveBy(state.h * Vec2(u.vx, u.vy));
    if (u.omega == 0.0) continue;
    r.angle += state.h * u.omega;
    r.rotation = Rotation::of(r.angle);
  }
}

}  // namespace merge2d
