#pragma once
/// A scene as plain data: what a file says, with `repeat` written out, angles in radians, and all
/// defaults filled in. Loading makes one, `World` takes one; tests and benchmarks write them by
/// hand.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "src2d/geometry/shape.h"
#include "src2d/scene/settings.h"

namespace merge2d {

/// The time of what never ends [s]; the strength of what never breaks.
inline constexpr double kForever = std::numeric_limits<double>::infinity();

enum class Motion : std::uint8_t { Dynamic, Pinned, Scripted };

/// offset = axis · amplitude · (1 − cos(2π t / period)): starts at rest.
struct Sinusoid {
  Vec2 axis = Vec2::UnitX();
  double amplitude = 1.0;  ///< [m]
  double period = 1.0;     ///< [s]
};

/// A smooth path through absolute poses of the body frame; it rests before the first and after the
/// last, and passes each key frame with a continuous velocity.
struct Keyframes {
  struct Key {
    double time = 0.0;  ///< [s], strictly increasing
    Vec2 position = Vec2::Zero();
    double angle = 0.0;  ///< [rad]
  };
  std::vector<Key> keys;
};

/// Constant velocity and spin from the starting pose.
struct SteadyMotion {
  Vec2 velocity = Vec2::Zero();  ///< [m/s]
  double spin = 0.0;             ///< [rad/s]
};

using Script = std::variant<Sinusoid, Keyframes, SteadyMotion>;

/// A body; shapes are in the body frame, whose origin need not be the centre of mass.
struct BodyDesc {
  std::string name;
  Motion motion = Motion::Dynamic;
  Vec2 at = Vec2::Zero();        ///< world position of the body frame's origin [m]
  double angle = 0.0;            ///< [rad]
  Vec2 velocity = Vec2::Zero();  ///< of the centre of mass [m/s]
  double spin = 0.0;             ///< [rad/s]
  std::vector<ConvexShape> shapes;
  std::optional<double> mass;  ///< [kg]; overrides density
  double density = 1.0;        ///< [kg/m²]
  double friction = 0.6;
  double restitution = 0.0;
  double rolling = 0.0;  ///< lever arm of the rolling resistance [m]
  double surface_velocity =
      0.0;                       ///< of a belt round the body, clockwise: on top to the right [m/s]
  double pinned_until = 0.0;     ///< pinned before this time, then dynamic [s]
  std::optional<Script> script;  ///< exactly when motion is Scripted
};

using BodyIndex = std::size_t;  ///< into Scene::bodies

/// From a point of a body to a world point or to a point of another body.
struct SpringDesc {
  BodyIndex body = 0;
  Vec2 anchor = Vec2::Zero();  ///< in the body frame [m]
  Vec2 to = Vec2::Zero();      ///< in the world, or in the frame of `to_body` [m]
  std::optional<BodyIndex> to_body;
  double stiffness = 0.0;    ///< [N/m]
  double damping = 0.0;      ///< [N s/m]
  double rest_length = 0.0;  ///< [m]
};

struct ImpulseDesc {
  BodyIndex body = 0;
  Vec2 at = Vec2::Zero();       ///< world point [m]
  Vec2 impulse = Vec2::Zero();  ///< [N s]
  double time = 0.0;            ///< [s]; given in the step that covers this time
};

struct ForceDesc {
  BodyIndex body = 0;
  Vec2 at = Vec2::Zero();     ///< in the body frame [m]
  Vec2 force = Vec2::Zero();  ///< in the world's directions [N]
  double from = 0.0;          ///< [s]
  double until = kForever;    ///< [s]
};

/// While on, a magnet's contacts are bilateral and do not slide.
struct MagnetDesc {
  BodyIndex body = 0;
  struct Interval {
    double from = 0.0;
    double until = kForever;
  };
  std::vector<Interval> on;  ///< in order, without overlap [s]
};

enum class JointKind {
  Revolute,   ///< the bodies share a point, and turn about it
  Weld,       ///< the bodies do not move against each other
  Distance,   ///< two points keep their distance
  Prismatic,  ///< the second body slides along an axis of the first, or the first along one of the
              ///< world, and does not turn
};

/// Holds two bodies together, or a body to the world. Places, directions and angles are those that
/// the bodies have at the start. Turns are counter-clockwise and ways go along the axis: those of
/// `b` against `a`, or of `a` against the world.
struct JointDesc {
  JointKind kind = JointKind::Revolute;
  BodyIndex a = 0;
  std::optional<BodyIndex> b;    ///< none: the world
  Vec2 at = Vec2::Zero();        ///< world point [m]; of a distance joint: its end on `a`
  Vec2 to = Vec2::Zero();        ///< distance: world point of the end on `b` [m]
  Vec2 axis = Vec2::UnitX();     ///< prismatic: where it slides to, in the world's directions
  std::optional<double> length;  ///< distance: default as at the start [m]
  double stiffness = 0.0;        ///< distance: a spring, unless 0 [N/m]
  double damping = 0.0;          ///< of that spring [N s/m]
  /// Of the turn [rad], the way along the axis [m], or the length [m].
  struct Limits {
    double lower = 0.0, upper = 0.0;
  };
  std::optional<Limits> limits;
  /// Drives with a speed [rad/s or m/s], as strongly as it can [N m or N].
  struct Motor {
    double speed = 0.0, strength = 0.0;
  };
  std::optional<Motor> motor;
  double compliance = 0.0;        ///< gives way by so much under a force or torque [m/N, rad/(N m)]
  double break_force = kForever;  ///< a larger force breaks it [N]
  double break_torque = kForever;  ///< weld and prismatic: so does a larger torque [N m]
  bool collide = false;            ///< whether the two bodies touch each other
};

/// Adds copies of a body while the scene runs. All of them are numbered from the start, after the
/// bodies of the scene, and named "name[k]".
struct EmitterDesc {
  BodyDesc body;               ///< the template; `at` is where it appears
  double every = 1.0;          ///< [s] between two bodies
  double start = 0.0;          ///< time of the first [s]
  int count = 0;               ///< how many in all
  Vec2 spread = Vec2::Zero();  ///< half extents of the uniform random offset [m]
  std::uint64_t seed = 1;
};

struct Camera {
  Vec2 center = Vec2::Zero();  ///< [m]
  double height = 10.0;        ///< of the visible part of the world [m]
};

/// Limits of what a scene may ask for; loading enforces them with an InputError.
struct SceneLimits {
  static constexpr std::size_t kBodies = 100'000;
  static constexpr std::size_t kJoints = 100'000;
  static constexpr std::size_t kShapesPerBody = 10'000;
  static constexpr std::size_t kFileBytes = 64u << 20;
  static constexpr std::size_t kDrawingPixels = 4u << 20;
  static constexpr int kNesting = 16;
  static constexpr std::size_t kVertices = 1'000;  ///< of one polygon
  static constexpr double kCoordinate = 1e6;       ///< [m]
  static constexpr double kSmallest = 1e-4;        ///< least width, height and radius [m]
  static constexpr double kNumber = 1e12;          ///< of any kind
};

struct Scene {
  std::string name;  ///< file stem or built-in name
  std::string title;
  Vec2 gravity{0.0, -9.81};  ///< [m/s²]
  double step = 0.01;        ///< h [s]
  double duration = 10.0;    ///< [s]
  std::uint64_t seed = 1;
  std::optional<Camera> camera;     ///< default: fits all bodies over the whole run
  std::optional<BodyIndex> follow;  ///< the camera moves with this body
  double margin = 0.06;             ///< of a camera that fits, on each side, as a part of its view
  Settings settings;
  std::vector<BodyDesc> bodies;
  std::vector<SpringDesc> springs;
  std::vector<ImpulseDesc> impulses;
  std::vector<ForceDesc> forces;
  std::vector<MagnetDesc> magnets;
  std::vector<JointDesc> joints;
  std::vector<EmitterDesc> emitters;
  std::vector<std::string> warnings;  ///< whole sentences for the user, in order
};

}  // namespace merge2d
