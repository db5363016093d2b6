#pragma once
/// Bodies as they were described, and the rigid things that are simulated.

#include <cstdint>

#include "src2d/core/ids.h"
#include "src2d/geometry/box.h"
#include "src2d/scene/scene.h"

namespace merge2d {

/// A rigid thing: body `i` is rigid `i`; collections follow after the last body.
enum class RigidId : std::uint32_t {};
constexpr std::size_t index(RigidId id) { return static_cast<std::size_t>(id); }
constexpr RigidId rigidOf(BodyId id) { return RigidId{static_cast<std::uint32_t>(id)}; }

/// Bodies that never move against each other share a frame: 0 is the world (all pinned bodies), a
/// scripted body has its own. `kFloating` means: responds to forces.
using FrameId = std::int32_t;
inline constexpr FrameId kFloating = -1;
inline constexpr FrameId kWorldFrame = 0;

/// How far a rigid thing reaches, in its frame. Bodies of one shape share theirs.
struct Extent {
  Aabb bounds;      ///< [m]
  OrientedBox box;  ///< [m]
};

/// One rigid thing. Its frame is fixed to the matter; for a collection the centre of mass moves in
/// it as members come and go.
struct Rigid {
  Vec2 x = Vec2::Zero();       ///< centre of mass (the frame's origin when not floating) [m]
  Vec2 rest = Vec2::Zero();    ///< the part of it below the grid of positions [m]
  Vec2 center = Vec2::Zero();  ///< centre of mass in the frame [m]
  Vec2 v = Vec2::Zero();       ///< of the centre of mass [m/s]
  double omega = 0.0;          ///< [rad/s]
  double angle = 0.0;          ///< [rad]
  Rotation rotation;           ///< of `angle`
  Rotation previous_rotation;  ///< before the last position update
  double mass = 0.0, inertia = 0.0;
  double inv_mass = 0.0, inv_inertia = 0.0;  ///< 0 unless floating
  std::uint32_t extent = 0;                  ///< into State::extents
  FrameId anchor = kFloating;                ///< the frame it is fixed to
  int leaf = -1;                             ///< in the broadphase; −1: not simulated as its own
  int slow_steps = 0;   ///< consecutive steps below the sleeping threshold, under a steady load
  int quiet_steps = 0;  ///< those of them in which it was also in balance
  bool asleep = false;
  bool resized = false;      ///< bounds changed since the broadphase last looked
  std::uint32_t member = 0;  ///< of a body in a collection: its place among the members

  bool present() const { return leaf >= 0; }
  bool floating() const { return anchor == kFloating; }
  bool still() const { return v == Vec2::Zero() && omega == 0.0; }
  /// Fixed to a frame that moves.
  bool isOnMovingFrame() const { return anchor > kWorldFrame && !still(); }
  /// It must come to rest anew before it may sleep.
  void stir() { slow_steps = quiet_steps = 0; }
  Vec2 exactCenter() const { return x + rest; }
  /// Moves the centre of mass. The part below the grid is kept for the next time, so that rounding
  /// never adds up.
  void moveBy(const Vec2& d) {
    const Vec2 way = rest + d, rounded = onGrid(way);
    x += rounded;
    rest = way - rounded;
  }
  Pose frame() const { return {x + onGrid(rest - rotation * center), rotation}; }
  Vec2 velocityAt(const Vec2& p) const { return v + cross(omega, p - x - rest); }
  /// The same where another's centre of mass is, to which no sum of a place and a rest is exact.
  Vec2 velocityAt(const Rigid& o) const { return v + cross(omega, (o.x - x) + (o.rest - rest)); }
};

/// True for two that are fixed to the same frame: they never move against each other.
inline bool sameFrame(const Rigid& a, const Rigid& b) {
  return !a.floating() && a.anchor == b.anchor;
}
/// Each is fixed to a frame of its own: the full solve has no row between them.
inline bool areOnTwoFrames(const Rigid& a, const Rigid& b) {
  return !a.floating() && !b.floating() && a.anchor != b.anchor;
}

/// A body's own constants, and where it is found now.
struct Body {
  std::uint32_t first_shape = 0, shape_count = 0;  ///< into State::shape_collider
  RigidId rigid{};                                 ///< itself, or its collection
  Motion motion = Motion::Dynamic;
  bool alive = true;  ///< false before its emission
  bool magnet_on = false;
  double mass = 0.0, inertia = 0.0;
  double friction = 0.0, restitution = 0.0;
  float rolling = 0.0F;           ///< lever arm of the rolling resistance [m]
  float surface_velocity = 0.0F;  ///< of its belt [m/s]
  double local_angle = 0.0;       ///< pose in the collection's frame
  Vec2 local = Vec2::Zero();
  Rotation local_rotation;
  Vec2 load = Vec2::Zero();         ///< outer forces now [N]
  Vec2 steady_load = Vec2::Zero();  ///< the same when it last changed by more than a trace
};

}  // namespace merge2d
