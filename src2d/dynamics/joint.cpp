#include "src2d/dynamics/joint.h"

#include <Eigen/LU>
#include <algorithm>
#include <optional>

#include "src2d/core/sorted_tail.h"
#include "src2d/dynamics/stabilise.h"
#include "src2d/dynamics/state.h"

namespace merge2d {
namespace {

/// Its bodies do not touch while it holds.
bool partsBodies(const Joint& joint) { return !joint.to_world && !joint.collide; }

/// Lists a joint, and its bodies behind the pairs that are in order.
void list(State& state, std::uint32_t i) {
  const Joint& joint = state.joints[i];
  state.joint_lists.of_body.add(i, joint.a, joint.to_world ? std::nullopt : std::optional(joint.b));
  if (joint.broken) return;
  state.joint_lists.present.push_back(i);
  if (partsBodies(joint)) state.joined_pairs.push_back(pairOf(joint));
}

/// One such element of a list that is in order, if there is any.
template <class T>
void eraseFrom(std::vector<T>& list, const T& element) {
  const auto at = std::ranges::lower_bound(list, element);
  if (at != list.end() && *at == element) list.erase(at);
}

bool postStabilised(const State& state) {
  return state.settings.solver.stabilisation == Stabilisation::Post;
}

/// Fills the rows of a block and what is derived from them.
class JointBuilder {
 public:
  JointBuilder(const State& state, const Joint& joint, const JointPlace& place, JointRows kind,
               const SolverVelocity& a, const SolverVelocity& b)
      : state_(state), joint_(joint), place_(place), a_(a), b_(b) {
    const bool corrects = kind == JointRows::Correcting;
    const bool soft = !corrects && joint.compliance > 0.0;
    rigid_ = !soft && (kind == JointRows::Keeping || (!corrects && postStabilised(state)));
    share_ = corrects ? kCorrectedShare : soft ? 1.0 : state.settings.solver.erp;
    // An implicit spring: λ = −h (s + h w) / compliance.
    if (soft) softness_ = joint.compliance / (state.h * state.h);
  }

  JointBlock build() {
    block_.lambda = joint_.lambda;
    const Vec2 way = wayOf(place_);
    switch (joint_.kind) {
      case JointKind::Revolute:
        hold(along(Vec2::UnitX()), way.x());
        hold(along(Vec2::UnitY()), way.y());
        drive(turning(), place_.turn);
        break;
      case JointKind::Weld:
        hold(along(Vec2::UnitX()), way.x());
        hold(along(Vec2::UnitY()), way.y());
        hold(turning(), place_.turn);
        break;
      case JointKind::Prismatic:
        hold(along(perpendicular(joint_.axis)), perpendicular(joint_.axis).dot(way));
        hold(turning(), place_.turn);
        drive(along(joint_.axis), joint_.axis.dot(way));
        break;
      case JointKind::Distance:
        distance();
        break;
    }
    fillInverse(block_, a_, b_);
    return block_;
  }

 private:
  JointRow along(const Vec2& direction) const { return rowAlong(place_.axes * direction); }
  JointRow rowAlong(const Vec2& d) const {
    JointRow row;
    row.dx = d.x();
    row.dy = d.y();
    row.arm_a = cross(place_.at - place_.x_a, d);
    row.arm_b = cross(place_.at - place_.x_b, d);
    row.softness = softness_;
    return row;
  }
  JointRow turning() const {
    JointRow row;
    row.arm_a = row.arm_b = 1.0;
    row.softness = softness_;
    return row;
  }

  /// A row that keeps `error` at 0.
  void hold(JointRow row, double error) {
    row.bias = rigid_ ? 0.0 : share_ * error / state_.h;
    block_.rows[static_cast<std::size_t>(block_.coupled++)] = row;
  }

  /// Motor and limit of what is free.
  void drive(JointRow row, double value) {
    if (joint_.motor) {
      JointRow& motor = block_.rows[kMotorRow] = row;
      motor.softness = 0.0;
      motor.bias = -joint_.motor->speed;
      motor.upper = joint_.motor->strength * state_.h;
      motor.lower = -motor.upper;
      block_.motor = true;
    }
    limit(row, value);
  }

  /// The nearer limit: met as a contact is, never overrun in a step, unless it is soft.
  void limit(JointRow row, double value) {
    if (!joint_.limits) return;
    const auto [lower, upper] = *joint_.limits;
    const bool at_lower = value - lower < upper - value;
    const double gap = at_lower ? value - lower : upper - value;
    const double sign = at_lower ? 1.0 : -1.0;
    const double way = gap > 0.0 ? gap / state_.h : share_ * gap / state_.h;
    const bool pressed = joint_.lambda[kLimitRow] != 0.0;
    row.bias = rigid_ && (pressed || gap <= 0.0) ? 0.0 : sign * way;
    if (lower != upper) (at_lower ? row.lower : row.upper) = 0.0;
    block_.rows[kLimitRow] = row;
    block_.limit = true;
    block_.lambda[kLimitRow] = std::clamp(block_.lambda[kLimitRow], row.lower, row.upper);
  }

  void distance() {
    const Vec2 way = place_.p_b - place_.p_a;
    const double length = way.norm();
    constexpr double kShort = 1e-9;
    JointRow row = length > kShort ? rowAlong(way / length) : along(Vec2::UnitX());
    if (joint_.limits) return limit(row, length);
    if (joint_.stiffness > 0.0) return spring(row, length - joint_.length);
    hold(row, length - joint_.length);
  }

  /// An implicit spring as a soft row: λ = −h (k (s + h w) + c w), stable however stiff.
  void spring(JointRow row, double stretch) {
    const double k = joint_.stiffness, h = state_.h;
    row.softness = 1.0 / (h * (joint_.damping + h * k));
    row.bias = stretch * h * k * row.softness;
    block_.rows[static_cast<std::size_t>(block_.coupled++)] = row;
  }

  const State& state_;
  const Joint& joint_;
  const JointPlace& place_;
  const SolverVelocity &a_, &b_;
  bool rigid_ = false;  ///< rows keep the error
  double softness_ = 0.0, share_ = 0.0;
  JointBlock block_;
};

/// Impulses along the joint's axes of the rows that carry a force, and about where it acts; motors
/// and limits of a revolute joint carry a torque.
JointForce loadOf(const Joint& joint, const Vec2& direction) {
  const auto& l = joint.lambda;
  switch (joint.kind) {
    case JointKind::Revolute:
      return {Vec2(l[0], l[1]), l[2] + l[3]};
    case JointKind::Weld:
      return {Vec2(l[0], l[1]), l[2]};
    case JointKind::Prismatic:
      return {l[0] * perpendicular(joint.axis) + (l[2] + l[3]) * joint.axis, l[1]};
    case JointKind::Distance:
      return {(l[0] + l[3]) * direction, 0.0};
  }
  return {};
}

}  // namespace

JointErrors errorsOf(const Joint& joint, const JointPlace& place) {
  const Vec2 way = wayOf(place);
  switch (joint.kind) {
    case JointKind::Revolute:
      return {way.x(), way.y(), 0.0, place.turn};
    case JointKind::Weld:
      return {way.x(), way.y(), place.turn, 0.0};
    case JointKind::Prismatic:
      return {perpendicular(joint.axis).dot(way), place.turn, 0.0, joint.axis.dot(way)};
    case JointKind::Distance:
      return {way.norm() - joint.length, 0.0, 0.0, way.norm()};
  }
  return {};
}

bool holds(const State& state, const Joint& joint) {
  return !joint.broken && state[joint.a].alive && (joint.to_world || state[joint.b].alive);
}

bool isInside(const State& state, const Joint& joint) {
  const RigidId ra = state[joint.a].rigid;
  const Rigid& a = state[ra];
  const bool a_in = state.isCollection(ra);
  if (joint.to_world) return a_in && a.anchor == kWorldFrame;
  const RigidId rb = state[joint.b].rigid;
  if (ra == rb) return true;
  return a_in != state.isCollection(rb) && !a.floating() && a.anchor == state[rb].anchor;
}

bool isOnTwoFrames(const State& state, const Joint& joint) {
  const Rigid& a = state.rigid(joint.a);
  if (joint.to_world) return !a.floating() && a.anchor != kWorldFrame;
  return areOnTwoFrames(a, state.rigid(joint.b));
}

std::uint32_t rigidIndexA(const State& state, const Joint& joint) {
  return static_cast<std::uint32_t>(state[joint.a].rigid);
}
std::uint32_t rigidIndexB(const State& state, const Joint& joint) {
  return static_cast<std::uint32_t>(joint.to_world ? state.rigids.size()
                                                   : index(state[joint.b].rigid));
}
std::uint32_t bodyIndexA(const Joint& joint) { return static_cast<std::uint32_t>(joint.a); }
std::uint32_t bodyIndexB(const State& state, const Joint& joint) {
  return static_cast<std::uint32_t>(joint.to_world ? state.bodies.size() : index(joint.b));
}

JointPlace placeOf(const State& state, const Joint& joint, const Pose& frame, const Vec2& x_a,
                   const Vec2& x_b) {
  const Pose back = frame.inverse();
  const Pose a = state.pose(joint.a);
  JointPlace place;
  place.x_a = back * x_a;
  place.x_b = back * x_b;
  place.p_a = back * (a * joint.anchor_a);
  place.p_b = back * (joint.to_world ? joint.anchor_b : state.pose(joint.b) * joint.anchor_b);
  const double angle_b = joint.to_world ? 0.0 : state.angle(joint.b);
  place.turn = angle_b - state.angle(joint.a) - joint.reference;
  const bool rail = slidesOnWorld(joint);
  place.at = rail ? place.p_a : place.p_b;
  place.axes = back.rotation * (rail ? Rotation::of(-joint.reference) : a.rotation);
  return place;
}

JointBlock makeJointBlock(const State& state, const Joint& joint, const JointPlace& place,
                          JointRows rows, const SolverVelocity& a, const SolverVelocity& b) {
  return JointBuilder(state, joint, place, rows, a, b).build();
}

JointForce jointForce(const State& state, const Joint& joint) {
  const JointPlace place = placeOf(state, joint, {}, Vec2::Zero(), Vec2::Zero());
  const Vec2 way = wayOf(place);
  const double length = way.norm();
  const JointForce load = loadOf(joint, length > 0.0 ? Vec2(way / length) : Vec2::UnitX());
  const Vec2 impulse = place.axes * load.force;
  return {impulse / state.h, (load.torque + cross(place.at - place.p_b, impulse)) / state.h};
}

namespace {

/// A rigid thing as the full solve takes it.
SolverVelocity moverVelocity(const Rigid& r, const Vec2& v) {
  const bool moves = r.floating() && !r.asleep;
  return {v.x(), v.y(), r.omega, moves ? r.inv_mass : 0.0, moves ? r.inv_inertia : 0.0};
}

/// The velocities of the ends are those before the bodies turned in the last step: the centripetal
/// part of a force acts all the time, and is no jerk.
SolverVelocity beforeTurn(const Rigid& r, const Vec2& end) {
  const Vec2 arm = end - r.x;
  const Vec2 before = r.previous_rotation * (r.rotation.inverse() * arm);
  return moverVelocity(r, r.v + cross(r.omega, before) - cross(r.omega, arm));
}

}  // namespace

double jerkOf(const State& state, const Joint& joint) {
  const Rigid& r_a = state.rigid(joint.a);
  const Rigid* r_b = joint.to_world ? nullptr : &state.rigid(joint.b);
  const JointPlace place = placeOf(state, joint, {}, r_a.x, r_b ? r_b->x : Vec2(Vec2::Zero()));
  const bool of_rod = joint.kind == JointKind::Distance;
  const SolverVelocity a = beforeTurn(r_a, of_rod ? place.p_a : place.at);
  const SolverVelocity b = r_b ? beforeTurn(*r_b, place.p_b) : SolverVelocity{};
  if (a.inv_mass == 0.0 && b.inv_mass == 0.0) return 0.0;
  double reach = 0.0;
  if (a.inv_mass > 0.0) reach = reachFrom(state, joint.a, joint.anchor_a);
  if (b.inv_mass > 0.0) reach = std::max(reach, reachFrom(state, joint.b, joint.anchor_b));
  const JointBlock k = makeJointBlock(state, joint, place, JointRows::Removing, a, b);
  const std::array<double, 4> change = changeBySolving(k, a, b);
  double most = 0.0;
  k.forEachRow([&](std::size_t i) {
    most = std::max(most, std::abs(change[i]) * (k.rows[i].turns() ? reach : 1.0));
  });
  return most;
}

double reachFrom(const State& state, BodyId body, const Vec2& anchor) {
  const OrientedBox& box = state.extent(rigidOf(body)).box;
  return (box.frame.position - anchor).norm() + box.half.norm();
}

bool breaks(const State& state, const Joint& joint) {
  if (joint.broken) return false;
  if (joint.break_force == kForever && joint.break_torque == kForever) return false;
  const JointForce load = jointForce(state, joint);
  const bool turns = joint.kind == JointKind::Weld || joint.kind == JointKind::Prismatic;
  return load.force.norm() > joint.break_force ||
         (turns && std::abs(load.torque) > joint.break_torque);
}

void breakJoint(State& state, Scratch& scratch, Joint& joint) {
  scratch.events.push_back({EventType::Break, joint.a, joint.to_world ? joint.a : joint.b});
  joint.broken = true;
  joint.lambda = {};
  for (const BodyId body : {joint.a, joint.to_world ? joint.a : joint.b}) {
    if (state.responds(body)) state.rigid(body).resized = true;  // the broadphase is to look again
  }
  eraseFrom(state.joint_lists.present, static_cast<std::uint32_t>(&joint - state.joints.data()));
  if (partsBodies(joint)) eraseFrom(state.joined_pairs, pairOf(joint));
}

int freedomsTaken(const State& state, const Joint& joint) {
  if (joint.kind == JointKind::Weld) return 3;
  if (joint.kind == JointKind::Distance) {
    return joint.stiffness == 0.0 && (!joint.limits || joint.lambda[kLimitRow] != 0.0) ? 1 : 0;
  }
  // A brake that is strong enough, or a limit that presses, takes the last freedom.
  const double load = std::abs(joint.lambda[kMotorRow]);
  const bool brake =
      joint.motor && joint.motor->speed == 0.0 && load < joint.motor->strength * state.h;
  return brake || joint.lambda[kLimitRow] != 0.0 ? 3 : 2;
}

bool joined(const State& state, BodyId a, BodyId b) {
  const auto& pairs = state.joined_pairs;
  return !pairs.empty() &&
         std::binary_search(pairs.begin(), pairs.end(), std::pair(std::min(a, b), std::max(a, b)));
}

void listNewJoint(State& state) {
  list(state, static_cast<std::uint32_t>(state.joints.size() - 1));
  sortTail(state.joined_pairs);
}

void listJoints(State& state) {
  state.joint_lists = {};
  state.joined_pairs.clear();
  for (std::uint32_t i = 0; i < state.joints.size(); ++i) list(state, i);
  std::ranges::sort(state.joined_pairs);
}

}  // namespace merge2d
