#pragma once
/// Rigid placements of the plane.

#include "src2d/core/grid.h"
#include "src2d/core/trig.h"

namespace merge2d {

/// A rotation by an angle, kept as its cosine and sine.
struct Rotation {
  double c = 1.0;
  double s = 0.0;

  static Rotation of(double angle) {
    const SineCosine sc = sineCosine(angle);
    return {sc.c, sc.s};
  }

  Vec2 operator*(const Vec2& a) const { return {c * a.x() - s * a.y(), s * a.x() + c * a.y()}; }
  Rotation operator*(const Rotation& o) const { return {c * o.c - s * o.s, s * o.c + c * o.s}; }
  Rotation inverse() const { return {c, -s}; }
  double angle() const { return arcTangent(s, c); }
};

/// Places a local frame in the world: world = position + rotation · local, on the grid when the
/// position is.
struct Pose {
  Vec2 position = Vec2::Zero();  ///< [m]
  Rotation rotation;

  static Pose at(const Vec2& position, double angle) { return {position, Rotation::of(angle)}; }

  Vec2 operator*(const Vec2& local) const { return position + onGrid(rotation * local); }
  /// The same off the grid: within the frame of a body a place is as exact as a double can be.
  Vec2 exactly(const Vec2& local) const { return position + rotation * local; }
  Pose operator*(const Pose& o) const { return {*this * o.position, rotation * o.rotation}; }

  Pose inverse() const {
    const Rotation r = rotation.inverse();
    return {-(r * position), r};
  }
  /// The local coordinates of a world point.
  Vec2 toLocal(const Vec2& world) const { return rotation.inverse() * (world - position); }
  /// Another placement seen from this one.
  Pose toLocal(const Pose& world) const {
    return {toLocal(world.position), rotation.inverse() * world.rotation};
  }
};

}  // namespace merge2d
