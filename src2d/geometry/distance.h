#pragma once
/// The distance of two convex shapes, in double.

#include "src2d/geometry/collide.h"

namespace merge2d {

/// The nearest points of two shapes, seen from A's frame.
struct Nearest {
  double distance = 0.0;        ///< 0 when they touch or overlap [m]
  Vec2 normal = Vec2::UnitX();  ///< from A to B, unit; says nothing when the distance is 0
};

/// Of `a` and `b` when `b`'s body has the pose `b_in_a` in the frame of `a`'s body.
Nearest nearest(const Collider& a, const Collider& b, const Pose& b_in_a);

/// The farthest that the outline of a shape reaches from `center`; of a disc, its centre [m].
double reachFrom(const Collider& shape, const Vec2& center);

}  // namespace merge2d
