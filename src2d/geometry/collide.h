#pragma once
/// Contact manifolds between two convex shapes. Box2D finds the features; the relative pose and the
/// gaps are in double, seen from body A, so that precision does not depend on where in the world a
/// contact is.

#include <array>
#include <cstdint>

#include "src2d/geometry/shape.h"

namespace merge2d {

/// A shape prepared for collision: Box2D's float copy beside the exact vertices.
class Collider {
 public:
  explicit Collider(const ConvexShape& shape);

  const ConvexShape& shape() const { return shape_; }
  bool isCircle() const { return std::holds_alternative<Circle>(shape_); }
  const b2CircleShape& circle() const { return circle_; }
  const b2PolygonShape& polygon() const { return polygon_; }

 private:
  ConvexShape shape_;
  b2CircleShape circle_;
  b2PolygonShape polygon_;
};

/// One contact point, seen from A's frame.
struct ManifoldPoint {
  Vec2 position = Vec2::Zero();  ///< midway between the two surfaces [m]
  double gap = 0.0;              ///< signed distance along the normal, negative when overlapping [m]
  std::uint32_t feature = 0;     ///< Box2D's contact id: the same pair of features in every step
};

/// At most two points that share a normal.
struct Manifold {
  Vec2 normal = Vec2::UnitX();  ///< from A to B, unit, in A's frame
  int count = 0;
  std::array<ManifoldPoint, 2> points;
};

/// The manifold of `a` and `b` when `b`'s body has the pose `b_in_a` in the frame of `a`'s body.
/// Points whose gap is above `margin` [m] are left out.
Manifold collide(const Collider& a, const Collider& b, const Pose& b_in_a, double margin);

}  // namespace merge2d
