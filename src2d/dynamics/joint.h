#pragma once
/// Joints: what holds two bodies together without touching (Section 8.2, "Joint Constraints").
///
/// A joint acts at one point, that of its second body: its force is equal and opposite there, so
/// that joints keep momentum and angular momentum. Directions belong to the first body and turn
/// with it; so do the impulses that are remembered.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "src2d/core/ids.h"
#include "src2d/dynamics/joint_block.h"
#include "src2d/scene/scene.h"

namespace merge2d {

struct State;
struct Scratch;

struct Joint {
  // constant
  JointKind kind = JointKind::Revolute;
  BodyId a{}, b{};
  bool to_world = false;         ///< there is no `b`
  Vec2 anchor_a = Vec2::Zero();  ///< from a's centre of mass, in its frame [m]
  Vec2 anchor_b = Vec2::Zero();  ///< the same of b; a world point when there is none
  Vec2 axis = Vec2::UnitX();     ///< in a's frame
  double reference = 0.0;        ///< angle of b against a at the start [rad]
  double length = 0.0;           ///< [m]
  double stiffness = 0.0, damping = 0.0;
  double compliance = 0.0;  ///< [m/N, rad/(N m)]
  std::optional<JointDesc::Limits> limits;
  std::optional<JointDesc::Motor> motor;
  double break_force = kForever, break_torque = kForever;
  bool collide = false;

  // what moves
  bool broken = false;
  std::array<double, 4> lambda{};  ///< impulses of the last step, as in JointBlock
  std::array<float, 3> error{};    ///< of the coupled rows [m, rad]
  float breath = std::numeric_limits<float>::infinity();  ///< largest change of it in a step
  int quiet_steps = 0;             ///< consecutive steps in which the bodies could have merged
  std::array<float, 4> yielded{};  ///< way of each row inside a collection: of a soft one since it
                                   ///< merged, of another in consecutive steps at a bound [m/s,
                                   ///< rad/s]
};

/// The two bodies of a joint, ascending.
inline std::pair<BodyId, BodyId> pairOf(const Joint& joint) {
  return std::minmax(joint.a, joint.b);
}

/// Where the two ends are, in any one frame.
struct JointPlace {
  Vec2 x_a = Vec2::Zero(), x_b = Vec2::Zero();  ///< centres of mass of what responds [m]
  Vec2 p_a = Vec2::Zero(), p_b = Vec2::Zero();  ///< ends of the joint [m]
  Vec2 at = Vec2::Zero();                       ///< where its force acts [m]
  Rotation axes;      ///< of its directions: those of a, or of the world's rail
  double turn = 0.0;  ///< of b against a since the start [rad]
};

/// From a's end to b's, along the joint's axes [m].
inline Vec2 wayOf(const JointPlace& place) {
  return place.axes.inverse() * (place.p_b - place.p_a);
}

/// A rail of the world: it stays where it is, and the force acts where the slider is now.
inline bool slidesOnWorld(const Joint& joint) {
  return joint.to_world && joint.kind == JointKind::Prismatic;
}

/// How far a joint is from where it holds, row by row of its block; of a limit: where it stands [m,
/// rad].
using JointErrors = std::array<double, 4>;
JointErrors errorsOf(const Joint& joint, const JointPlace& place);

/// Whether rows are to remove the joint's error; only to keep it, inside a collection; or to
/// correct positions. The first two give way by its compliance.
enum class JointRows { Removing, Keeping, Correcting };

/// Bodies that are there, and not broken apart.
bool holds(const State& state, const Joint& joint);

/// A joint between members of one collection, or of one and its frame: it belongs to the sweep.
bool isInside(const State& state, const Joint& joint);

/// The ends are fixed to different frames, of which the world is one: the full solve has no row of
/// it.
bool isOnTwoFrames(const State& state, const Joint& joint);

/// Its index among the rigid things; the world stands behind the last of them.
std::uint32_t rigidIndexA(const State& state, const Joint& joint);
std::uint32_t rigidIndexB(const State& state, const Joint& joint);
/// The same among the bodies.
std::uint32_t bodyIndexA(const Joint& joint);
std::uint32_t bodyIndexB(const State& state, const Joint& joint);

/// Place of the ends in `frame`; arms are measured from the world points `x_a` and `x_b`.
JointPlace placeOf(const State& state, const Joint& joint, const Pose& frame, const Vec2& x_a,
                   const Vec2& x_b);

/// The rows of a joint with the impulses of the last step as a start.
JointBlock makeJointBlock(const State& state, const Joint& joint, const JointPlace& place,
                          JointRows rows, const SolverVelocity& a, const SolverVelocity& b);

/// Force [N] in the world's directions, and torque about b's end [N m], with which a joint acts on
/// b.
struct JointForce {
  Vec2 force = Vec2::Zero();
  double torque = 0.0;
};
JointForce jointForce(const State& state, const Joint& joint);

/// The largest change of the relative velocity of its bodies that a solve of its rows alone would
/// make beyond the impulses of the last step, at the corners of those that respond [m/s]: where a
/// rope becomes taut, a motor starts, or a script begins with a jerk.
double jerkOf(const State& state, const Joint& joint);

/// No corner of the box of a body is farther from a point in its frame [m].
double reachFrom(const State& state, BodyId body, const Vec2& anchor);

/// True when the force is more than it bears.
bool breaks(const State& state, const Joint& joint);

/// Parts the bodies for good, as an event; they touch each other from now on.
void breakJoint(State& state, Scratch& scratch, Joint& joint);

/// Relative freedoms that a joint takes away just now: two of a pivot, three of a weld.
int freedomsTaken(const State& state, const Joint& joint);

/// True for bodies that do not touch since they are joined.
bool joined(const State& state, BodyId a, BodyId b);

/// Lists the last joint of State::joints.
void listNewJoint(State& state);
/// Lists all of them anew, where nothing is parked.
void listJoints(State& state);

}  // namespace merge2d
