#include "src2d/dynamics/joint_rows.h"

#include <algorithm>

namespace merge2d {
namespace {

bool moves(const Scratch& scratch, std::uint32_t rigid) { return scratch.u[rigid].inv_mass > 0.0; }

JointBlock makeBlock(const State& state, const Scratch& scratch, const Joint& joint) {
  const std::uint32_t a = rigidIndexA(state, joint), b = rigidIndexB(state, joint);
  const Vec2 x_b = joint.to_world ? Vec2(Vec2::Zero()) : state.rigids[b].x;
  const JointPlace place = placeOf(state, joint, {}, state.rigids[a].x, x_b);
  JointBlock k = makeJointBlock(state, joint, place, JointRows::Soft, scratch.u[a], scratch.u[b]);
  k.a = a;
  k.b = b;
  return k;
}

/// How far the joint is from where it holds, and how much of that came in this step.
void measureError(Joint& joint, const JointPlace& place) {
  const Vec2 way = place.rotation_a.inverse() * (place.p_b - place.p_a);
  std::array<float, 3> error{static_cast<float>(way.x()), static_cast<float>(way.y()),
                             static_cast<float>(place.turn)};
  if (joint.kind == JointKind::Revolute) error[2] = 0.0F;
  if (joint.kind == JointKind::Distance) {
    error = {static_cast<float>(way.norm() - joint.length), 0.0F, 0.0F};
  }
  if (joint.kind == JointKind::Prismatic) {
    error[0] = static_cast<float>(perpendicular(joint.axis).dot(way));
    error[1] = 0.0F;
  }
  joint.breath = 0.0F;
  for (std::size_t i = 0; i < 3; ++i) {
    joint.breath = std::max(joint.breath, std::abs(error[i] - joint.error[i]));
  }
  joint.error = error;
}

/// Joints alone make islands too.
void insertIslands(Scratch& scratch) {
  std::size_t next = 0;
  const std::size_t with_contacts = scratch.islands.size();
  for (const JointOrder& order : scratch.joint_order) {
    while (next < with_contacts && scratch.islands[next].root < order.island) ++next;
    const bool known = next < with_contacts && scratch.islands[next].root == order.island;
    const bool listed = !scratch.islands.empty() && scratch.islands.back().root == order.island;
    if (known || listed) continue;
    scratch.islands.push_back({.root = order.island});
  }
  std::inplace_merge(
      scratch.islands.begin(), scratch.islands.begin() + static_cast<std::ptrdiff_t>(with_contacts),
      scratch.islands.end(), [](const Island& x, const Island& y) { return x.root < y.root; });
}

}  // namespace

void uniteJoints(const State& state, Scratch& scratch) {
  scratch.joint_order.clear();
  for (std::uint32_t i = 0; i < state.joints.size(); ++i) {
    const Joint& joint = state.joints[i];
    if (!holds(state, joint) || isInside(state, joint)) continue;
    const std::uint32_t a = rigidIndexA(state, joint), b = rigidIndexB(state, joint);
    const bool a_moves = moves(scratch, a), b_moves = moves(scratch, b);
    if (!a_moves && !b_moves) continue;
    if (a_moves && b_moves) scratch.sets.unite(a, b);
    scratch.joint_order.push_back({a_moves ? a : b, i});
  }
}

void buildJointBlocks(State& state, Scratch& scratch) {
  scratch.joint_blocks.clear();
  if (scratch.joint_order.empty()) return;
  for (JointOrder& order : scratch.joint_order) order.island = scratch.sets.find(order.island);
  std::sort(scratch.joint_order.begin(), scratch.joint_order.end());
  insertIslands(scratch);
  auto island = scratch.islands.begin();
  for (const JointOrder& order : scratch.joint_order) {
    Joint& joint = state.joints[order.joint];
    const auto here = static_cast<std::uint32_t>(scratch.joint_blocks.size());
    while (island->root != order.island) ++island;
    if (island->first_joint == island->last_joint) island->first_joint = island->last_joint = here;
    island->last_joint += 1;
    scratch.joint_blocks.push_back(makeBlock(state, scratch, joint));
    JointBlock& k = scratch.joint_blocks.back();
    k.joint = order.joint;
    measureError(joint, placeOf(state, joint, {}, Vec2::Zero(), Vec2::Zero()));
    for (const std::uint32_t r : {k.a, k.b}) {
      if (moves(scratch, r)) scratch.colours[r] |= 1;  // its body belongs to an island
    }
  }
}

void warmStartJoints(std::span<const JointBlock> joints, std::vector<SolverVelocity>& u) {
  for (const JointBlock& k : joints) applyJointImpulses(k, {}, u[k.a], u[k.b]);
}

void sweepJoints(std::span<JointBlock> joints, std::vector<SolverVelocity>& u) {
  for (JointBlock& k : joints) solveJoint(k, {}, u[k.a], u[k.b]);
}

void storeJointImpulses(State& state, Scratch& scratch) {
  for (const JointBlock& k : scratch.joint_blocks) {
    Joint& joint = state.joints[k.joint];
    joint.lambda = k.lambda;
    if (breaks(state, joint)) breakJoint(state, scratch, joint);
  }
  for (const std::uint32_t i : scratch.overloaded_joints) {
    if (!state.joints[i].broken) breakJoint(state, scratch, state.joints[i]);
  }
  scratch.overloaded_joints.clear();
}

}  // namespace merge2d
