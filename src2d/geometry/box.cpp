/// Bounding boxes. A minimal-area box has a side along an edge of the convex hull (Freeman and
/// Shapira 1975), so it is enough to try each edge.

#include "src2d/geometry/box.h"

#include <algorithm>
#include <array>

namespace merge2d {

Aabb bounds(const ConvexShape& shape, const Pose& pose) {
  Aabb box;
  if (const auto* circle = std::get_if<Circle>(&shape)) {
    box.include(pose.exactly(circle->center));
    return box.grown(circle->radius);
  }
  for (const Vec2& v : std::get<Polygon>(shape).vertices) box.include(pose.exactly(v));
  return box;
}

std::vector<Vec2> outlinePoints(const ConvexShape& shape) {
  if (const auto* circle = std::get_if<Circle>(&shape)) {
    const double d = 2.0 * circle->radius;
    return makeBox(d, d, Pose::at(circle->center, 0.0)).vertices;
  }
  return std::get<Polygon>(shape).vertices;
}

namespace {

/// Leaves out what lies inside the octagon of the farthest points in eight directions (Akl and
/// Toussaint 1978): of a heap, nearly all.
void dropInnerPoints(std::vector<Vec2>& points) {
  constexpr std::size_t kDirections = 8;
  const std::array<Vec2, kDirections> directions{Vec2(1, 0),  Vec2(1, 1),  Vec2(0, 1),
                                                 Vec2(-1, 1), Vec2(-1, 0), Vec2(-1, -1),
                                                 Vec2(0, -1), Vec2(1, -1)};
  std::array<Vec2, kDirections> farthest;
  farthest.fill(points.front());
  for (const Vec2& p : points) {
    for (std::size_t d = 0; d < kDirections; ++d) {
      if (directions[d].dot(p) > directions[d].dot(farthest[d])) farthest[d] = p;
    }
  }
  std::erase_if(points, [&](const Vec2& p) {
    for (std::size_t d = 0; d < kDirections; ++d) {
      const Vec2& from = farthest[d];
      const Vec2 edge = farthest[(d + 1) % kDirections] - from;
      if (edge != Vec2::Zero() && cross(edge, p - from) <= 0.0) return false;
    }
    return true;
  });
}

/// Strictly convex hull, counter-clockwise (monotone chain, Andrew 1979).
std::vector<Vec2> convexHull(std::vector<Vec2> points) {
  constexpr std::size_t kMany = 64;
  if (points.size() > kMany) dropInnerPoints(points);
  const auto before = [](const Vec2& a, const Vec2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;

  std::vector<Vec2> hull;
  const auto add = [&](const Vec2& p, std::size_t fixed) {
    while (hull.size() > fixed &&
           cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
      hull.pop_back();
    hull.push_back(p);
  };
  for (const Vec2& p : points) add(p, 1);  // the lower side, from left to right
  const std::size_t lower = hull.size();
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) add(*p, lower);  // and back
  hull.pop_back();  // the first point again
  return hull;
}

/// The tight box whose axes are turned by `rotation`.
OrientedBox boxAlong(const Rotation& rotation, const std::vector<Vec2>& points) {
  const Rotation inverse = rotation.inverse();
  Aabb box;
  for (const Vec2& p : points) box.include(inverse * p);
  return {{rotation * box.center(), rotation}, 0.5 * box.extent()};
}

double areaOf(const OrientedBox& box) { return 4.0 * box.half.x() * box.half.y(); }

/// Of the four rotations that turn an axis to `edge`, the one within 45 degrees of none.
Rotation leastRotationTo(const Vec2& edge) {
  Vec2 axis = edge.normalized();
  while (axis.x() < std::abs(axis.y()) && axis.x() != axis.y()) axis = perpendicular(axis);
  return {axis.x(), axis.y()};
}

}  // namespace

OrientedBox tightBox(const std::vector<Vec2>& points) {
  if (points.empty()) return {};
  const std::vector<Vec2> hull = convexHull(points);

  // Start from the axis-aligned box; another one must be smaller by more than rounding.
  OrientedBox best = boxAlong({}, hull);
  double least = areaOf(best);
  for (std::size_t i = 0; i < hull.size() && hull.size() > 1; ++i) {
    const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
    const OrientedBox box = boxAlong(leastRotationTo(edge), hull);
    if (areaOf(box) < least * (1.0 - 1e-12)) {
      best = box;
      least = areaOf(box);
    }
  }
  return best;
}

}  // namespace merge2d
