#include "src2d/collections/joint_sweep.h"

#include <algorithm>

namespace merge2d {
namespace {

/// A member's centre of mass; the world at the other end does not respond, so any place will do.
Vec2 centerOf(const State& state, const Joint& joint, bool of_b) {
  if (of_b && joint.to_world) return Vec2::Zero();
  return state.pose(of_b ? joint.b : joint.a).position;
}

/// The rows of a joint in `frame`; bodies keep their own masses.
JointBlock memberJointBlock(const State& state, std::uint32_t i, const Pose& frame, JointRows rows,
                            const SolverVelocity& a, const SolverVelocity& b) {
  const Joint& joint = state.joints[i];
  const JointPlace place =
      placeOf(state, joint, frame, centerOf(state, joint, false), centerOf(state, joint, true));
  JointBlock k = makeJointBlock(state, joint, place, rows, a, b);
  k.a = bodyIndexA(joint);
  k.b = bodyIndexB(state, joint);
  k.joint = i;
  return k;
}

/// Joints that act in a collection, ascending: one of their ends at least is a member.
std::vector<std::uint32_t> jointsInside(const State& state, const Collection& c) {
  std::vector<std::uint32_t> inside;
  if (state.joints.empty()) return inside;
  for (const BodyId member : c.members) {
    state.joint_lists.of_body.forEach(member, [&](std::uint32_t i) {
      if (holds(state, state.joints[i]) && isInside(state, state.joints[i])) inside.push_back(i);
    });
  }
  std::ranges::sort(inside);
  inside.erase(std::unique(inside.begin(), inside.end()), inside.end());
  return inside;
}

bool floats(const State& state, std::uint32_t body) {
  return body < state.bodies.size() && state.rigid(BodyId{body}).floating();
}

}  // namespace

void layOutJoints(const State& state, Collection& c) {
  c.joints.clear();
  for (const std::uint32_t i : jointsInside(state, c)) {
    const Joint& joint = state.joints[i];
    c.joints.push_back(memberJointBlock(state, i, state[c.rigid].frame(), JointRows::Keeping,
                                        memberMasses(state, c, bodyIndexA(joint)),
                                        memberMasses(state, c, bodyIndexB(state, joint))));
  }
}

void listSweepJoints(const State& state, Scratch& scratch) {
  scratch.sweep_joints.clear();
  const auto& u = scratch.sweep_u;
  for (const std::uint32_t i : state.joint_lists.present) {
    const Joint& joint = state.joints[i];
    if (!holds(state, joint) || isInside(state, joint)) continue;
    const bool swept =
        state.isAwakeMember(joint.a) || (!joint.to_world && state.isAwakeMember(joint.b));
    const std::uint32_t a = bodyIndexA(joint), b = bodyIndexB(state, joint);
    if (!swept || (u[a].inv_mass == 0.0 && u[b].inv_mass == 0.0)) continue;
    scratch.sweep_joints.push_back(memberJointBlock(state, i, {}, JointRows::Removing, u[a], u[b]));
    for (const std::uint32_t body : {a, b}) {
      if (body < state.bodies.size()) scratch.near_collection[body] = 1;
    }
  }
}

void warmStartSweepJoints(const State& state, Scratch& scratch) {
  auto& u = scratch.sweep_u;
  std::size_t row = 0;
  for (const std::uint32_t i : state.joint_lists.present) {
    const Joint& joint = state.joints[i];
    const auto& rows = scratch.sweep_joints;
    const std::uint32_t a = bodyIndexA(joint), b = bodyIndexB(state, joint);
    if (row < rows.size() && rows[row].joint == i) {
      applyJointImpulses(rows[row++], {}, u[a], u[b]);
      continue;
    }
    const auto near = [&](std::uint32_t body) {
      return body < state.bodies.size() && scratch.near_collection[body] != 0;
    };
    if (!holds(state, joint) || isInside(state, joint) || (!near(a) && !near(b))) continue;
    applyJointImpulses(memberJointBlock(state, i, {}, JointRows::Removing, u[a], u[b]), {}, u[a],
                       u[b]);
  }
}

void keepJointForces(State& state, Scratch& scratch) {
  for (const JointBlock& k : scratch.sweep_joints) {
    if (floats(state, k.a) || floats(state, k.b)) continue;
    Joint& joint = state.joints[k.joint];
    joint.lambda = k.lambda;
    if (breaks(state, joint)) breakJoint(state, scratch, joint);
  }
  for (const Collection& c : state.collections) {
    if (c.id == kNoCollection || state[c.rigid].asleep) continue;
    for (const JointBlock& k : c.joints) state.joints[k.joint].lambda = k.lambda;
  }
}

}  // namespace merge2d
