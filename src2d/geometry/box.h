#pragma once
/// Boxes around shapes: axis-aligned for culling, oriented for the relative motion metric.

#include <array>
#include <vector>

#include "src2d/geometry/shape.h"

namespace merge2d {

/// Axis-aligned box. The default is empty: it contains nothing and including a point makes it that
/// point.
struct Aabb {
  Vec2 lower = Vec2::Constant(1e300);
  Vec2 upper = Vec2::Constant(-1e300);

  void include(const Vec2& p) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  void include(const Aabb& o) {
    lower = lower.cwiseMin(o.lower);
    upper = upper.cwiseMax(o.upper);
  }
  bool empty() const { return lower.x() > upper.x(); }
  Vec2 center() const { return 0.5 * (lower + upper); }
  Vec2 extent() const { return upper - lower; }
  bool contains(const Aabb& o) const {
    return (lower.array() <= o.lower.array()).all() && (upper.array() >= o.upper.array()).all();
  }
  bool overlaps(const Aabb& o) const {
    return (lower.array() <= o.upper.array()).all() && (upper.array() >= o.lower.array()).all();
  }
  /// How far apart they are along an axis, at least; below 0 they overlap [m].
  double distance(const Aabb& o) const {
    return (lower - o.upper).cwiseMax(o.lower - upper).maxCoeff();
  }
  Aabb grown(double margin) const {
    return {lower - Vec2::Constant(margin), upper + Vec2::Constant(margin)};
  }
};

/// The box around `box` as it is seen through `pose`.
inline Aabb placed(const Pose& pose, const Aabb& box) {
  const Vec2 half = 0.5 * box.extent();
  const Vec2 center = pose.exactly(box.center());
  const double c = std::abs(pose.rotation.c), s = std::abs(pose.rotation.s);
  const Vec2 extent(c * half.x() + s * half.y(), s * half.x() + c * half.y());
  return {center - extent, center + extent};
}

/// Distance of the farthest corner of a box from a point, at most [m].
inline double farthestFrom(const Aabb& box, const Vec2& p) {
  return (box.lower - p).cwiseAbs().cwiseMax((box.upper - p).cwiseAbs()).norm();
}

/// The tight axis-aligned box of a shape placed at `pose`.
Aabb bounds(const ConvexShape& shape, const Pose& pose = {});

/// Oriented box: `frame` at its centre, half extents along the frame's axes (Section 5.2).
struct OrientedBox {
  Pose frame;
  Vec2 half = Vec2::Zero();  ///< [m]

  std::array<Vec2, 4> corners() const {
    return {frame.exactly({-half.x(), -half.y()}), frame.exactly({half.x(), -half.y()}),
            frame.exactly({half.x(), half.y()}), frame.exactly({-half.x(), half.y()})};
  }
};

/// Of all boxes with one side along an edge of the points' convex hull, the one of least area.
OrientedBox tightBox(const std::vector<Vec2>& points);

/// The points whose box is a shape's box: a polygon's vertices, or a disc's bounding square.
std::vector<Vec2> outlinePoints(const ConvexShape& shape);

}  // namespace merge2d
