#include "src2d/dynamics/joint_rows.h"

#include <algorithm>

namespace merge2d {
namespace {

bool moves(const Scratch& scratch, std::uint32_t rigid) { return scratch.u[rigid].inv_mass > 0.0; }

/// Turning by less in a step, nothing bends to speak of; by more, where it goes is a guess [rad].
constexpr double kStraight = 1e-6, kTooFast = 0.5;

/// The force on b, where it acts, and how stiff a rod under tension is across itself [N/m].
struct JointPull {
  Vec2 at = Vec2::Zero(), force = Vec2::Zero();
  double across = 0.0;
};
JointPull pullOf(const State& state, const Joint& joint) {
  const JointPlace place = placeOf(state, joint, {}, Vec2::Zero(), Vec2::Zero());
  JointPull pull{place.at, jointForce(state, joint).force};
  const Vec2 rod = place.p_b - place.p_a;
  if (joint.kind != JointKind::Distance || rod.squaredNorm() == 0.0) return pull;
  pull.across = std::max(0.0, -pull.force.dot(rod)) / rod.squaredNorm();
  return pull;
}

JointPlace placeIn(const State& state, const Joint& joint, const JointBlock& k) {
  const Vec2 x_b = joint.to_world ? Vec2(Vec2::Zero()) : state.rigids[k.b].x;
  return placeOf(state, joint, {}, state.rigids[k.a].x, x_b);
}

/// Where the ends are after a step with these velocities.
JointPlace afterStep(const Joint& joint, const JointPlace& now, const SolverVelocity& a,
                     const SolverVelocity& b, double h) {
  const Rotation turn_a = Rotation::of(h * a.omega), turn_b = Rotation::of(h * b.omega);
  JointPlace then = now;
  then.p_a = now.x_a + h * Vec2(a.vx, a.vy) + turn_a * (now.p_a - now.x_a);
  then.p_b = now.x_b + h * Vec2(b.vx, b.vy) + turn_b * (now.p_b - now.x_b);
  if (!slidesOnWorld(joint)) then.axes = turn_a * now.axes;
  then.turn += h * (b.omega - a.omega);
  return then;
}

/// How far a rod turns, or more [rad].
double turnOfRod(const JointPlace& now, const JointPlace& then) {
  const Vec2 before = now.p_b - now.p_a, after = then.p_b - then.p_a;
  const double length = before.norm();
  return length > 0.0 ? (after - before).norm() / length : 0.0;
}

SolverVelocity changeOf(const SolverVelocity& now, const SolverVelocity& before) {
  return {now.vx - before.vx, now.vy - before.vy, now.omega - before.omega};
}

std::uint32_t moverA(const State& state, const Scratch& scratch, const Joint& joint) {
  return static_cast<std::uint32_t>(moverOf(state, scratch, joint.a));
}
std::uint32_t moverB(const State& state, const Scratch& scratch, const Joint& joint) {
  if (joint.to_world) return static_cast<std::uint32_t>(state.rigids.size());
  return static_cast<std::uint32_t>(moverOf(state, scratch, joint.b));
}

/// Inside a collection that is not open.
bool isHidden(const State& state, const Scratch& scratch, const Joint& joint) {
  const auto open = [&](BodyId b) { return !scratch.open.empty() && scratch.open[index(b)] != 0; };
  return isInside(state, joint) && !open(joint.a) && (joint.to_world || !open(joint.b));
}

JointBlock outerJointBlock(const State& state, const Scratch& scratch, const Joint& joint) {
  const std::uint32_t a = moverA(state, scratch, joint), b = moverB(state, scratch, joint);
  const Vec2 x_b = joint.to_world ? Vec2(Vec2::Zero()) : state.rigids[b].x;
  const JointPlace place = placeOf(state, joint, {}, state.rigids[a].x, x_b);
  const JointRows rows = isInside(state, joint) ? JointRows::Keeping : JointRows::Removing;
  JointBlock k = makeJointBlock(state, joint, place, rows, scratch.u[a], scratch.u[b]);
  k.a = a;
  k.b = b;
  return k;
}

/// How far a joint is beyond its limits [m, rad].
double beyondLimits(const Joint& joint, const JointPlace& place) {
  if (!joint.limits) return 0.0;
  const double at = errorsOf(joint, place)[kLimitRow];
  return at - std::clamp(at, joint.limits->lower, joint.limits->upper);
}

/// How far the joint is from where it holds, or beyond its limits, and how much of that came in
/// this step: a motor may have turned it past a limit, and it must come back before it merges.
void measureError(Joint& joint, const JointPlace& place) {
  const Vec2 way = wayOf(place);
  std::array<float, 3> error{static_cast<float>(way.x()), static_cast<float>(way.y()),
                             static_cast<float>(place.turn)};
  const auto beyond = static_cast<float>(beyondLimits(joint, place));
  if (joint.kind == JointKind::Revolute) error[2] = beyond;
  if (joint.kind == JointKind::Distance) {
    error = {static_cast<float>(way.norm() - joint.length), 0.0F, 0.0F};
  }
  if (joint.kind == JointKind::Prismatic) {
    error[0] = static_cast<float>(perpendicular(joint.axis).dot(way));
    error[1] = beyond;
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
  for (const std::uint32_t i : state.joint_lists.present) {
    const Joint& joint = state.joints[i];
    if (!holds(state, joint) || isHidden(state, scratch, joint)) continue;
    const std::uint32_t a = moverA(state, scratch, joint), b = moverB(state, scratch, joint);
    const bool a_moves = moves(scratch, a), b_moves = moves(scratch, b);
    if (!a_moves && !b_moves) continue;
    if (a_moves && b_moves) scratch.sets.unite(a, b);
    scratch.joint_order.push_back({a_moves ? a : b, i});
  }
}

void slowTautLinks(const State& state, Scratch& scratch) {
  std::vector<TautLink>& taut = scratch.taut_links;
  resizeTightly(taut, state.rigids.size());
  for (const RigidId id : state.present) taut[index(id)] = {};
  for (const std::uint32_t i : state.joint_lists.present) {
    const Joint& joint = state.joints[i];
    if (!holds(state, joint) || isHidden(state, scratch, joint)) continue;
    const JointPull pull = pullOf(state, joint);
    const auto add = [&](std::uint32_t rigid, double sign) {
      if (!moves(scratch, rigid)) return;
      const Vec2 arm = pull.at - state.rigids[rigid].x;
      taut[rigid].turning += sign * arm.dot(pull.force);
      taut[rigid].moving += pull.across;
      taut[rigid].turning += pull.across * arm.squaredNorm();
    };
    add(moverA(state, scratch, joint), -1.0);
    if (!joint.to_world) add(moverB(state, scratch, joint), 1.0);
  }
  const double h2 = state.h * state.h;
  for (const RigidId id : state.present) {
    SolverVelocity& u = scratch.u[index(id)];
    const TautLink& link = taut[index(id)];
    if (link.turning * h2 * u.inv_inertia > 1.0) u.inv_inertia = 1.0 / (link.turning * h2);
    if (link.moving * h2 * u.inv_mass > 1.0) u.inv_mass = 1.0 / (link.moving * h2);
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
    scratch.joint_blocks.push_back(outerJointBlock(state, scratch, joint));
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

bool allowForBends(const State& state, std::span<JointBlock> joints,
                   const std::vector<SolverVelocity>& u, std::vector<JointErrors>& bends) {
  if (state.settings.solver.stabilisation == Stabilisation::Post) return false;
  bool any = false;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    JointBlock& k = joints[j];
    const SolverVelocity &a = u[k.a], &b = u[k.b];
    const Joint& joint = state.joints[k.joint];
    const JointPlace now = placeIn(state, joint, k), then = afterStep(joint, now, a, b, state.h);
    const double turn = joint.kind == JointKind::Distance
                            ? turnOfRod(now, then)
                            : state.h * std::max(std::abs(a.omega), std::abs(b.omega));
    if (turn < kStraight || turn > kTooFast) continue;
    const JointErrors before = errorsOf(joint, now), after = errorsOf(joint, then);
    const auto allow = [&](std::size_t i) {
      if (k.rows[i].softness > 0.0) return;
      const double bend = (after[i] - before[i]) / state.h - jointVelocity(k.rows[i], {}, a, b);
      k.rows[i].bias += bend - bends[j][i];
      bends[j][i] = bend;
      any |= bend != 0.0;
    };
    for (std::size_t i = 0; i < static_cast<std::size_t>(k.coupled); ++i) allow(i);
    if (k.limit && k.lambda[kLimitRow] != 0.0) allow(kLimitRow);
  }
  return any;
}

void rememberMotion(std::span<const JointBlock> joints, const std::vector<SolverVelocity>& u,
                    std::vector<JointMotion>& motion) {
  motion.clear();
  for (const JointBlock& k : joints) motion.push_back({u[k.a], u[k.b]});
}

bool correctionHolds(const State& state, std::span<const JointBlock> joints,
                     const std::vector<SolverVelocity>& u, const std::vector<JointMotion>& before,
                     double corrected) {
  double bent = 0.0;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const JointBlock& k = joints[j];
    const Joint& joint = state.joints[k.joint];
    const SolverVelocity a = changeOf(u[k.a], before[j].a), b = changeOf(u[k.b], before[j].b);
    const JointPlace now = placeIn(state, joint, k);
    const JointErrors here = errorsOf(joint, now);
    const JointErrors there = errorsOf(joint, afterStep(joint, now, a, b, state.h));
    for (std::size_t i = 0; i < static_cast<std::size_t>(k.coupled); ++i) {
      const double straight = state.h * jointVelocity(k.rows[i], {}, a, b);
      bent = std::max(bent, std::abs(there[i] - here[i] - straight));
    }
  }
  return bent <= 0.25 * corrected;
}

void storeJointImpulses(State& state, const Scratch& scratch) {
  for (const JointBlock& k : scratch.joint_blocks) state.joints[k.joint].lambda = k.lambda;
}

void breakOverloadedJoints(State& state, Scratch& scratch) {
  for (const JointBlock& k : scratch.joint_blocks) {
    Joint& joint = state.joints[k.joint];
    // Unmerge takes one apart that is inside an open collection.
    if (!isInside(state, joint) && breaks(state, joint)) breakJoint(state, scratch, joint);
  }
  for (const std::uint32_t i : scratch.overloaded_joints) {
    if (!state.joints[i].broken) breakJoint(state, scratch, state.joints[i]);
  }
  scratch.overloaded_joints.clear();
}

}  // namespace merge2d
