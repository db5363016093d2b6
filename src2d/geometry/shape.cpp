/// Areas and moments: the shoelace formulas, taken relative to a vertex so that they do not depend
/// on where the shape lies in its frame.

#include "src2d/geometry/shape.h"

#include <numbers>

namespace merge2d {
Polygon makeBox(double width, double height, const Pose& pose) {
  const double x = 0.5 * width;
  const double y = 0.5 * height;
  return {
      {pose.exactly({-x, -y}), pose.exactly({x, -y}), pose.exactly({x, y}), pose.exactly({-x, y})}};
}

ConvexShape transformed(const ConvexShape& shape, const Pose& pose) {
  if (const auto* circle = std::get_if<Circle>(&shape)) {
    return Circle{pose.exactly(circle->center), circle->radius};
  }
  Polygon moved = std::get<Polygon>(shape);
  for (Vec2& v : moved.vertices) v = pose.exactly(v);
  return moved;
}

namespace {

AreaProperties areaOf(const Circle& circle) {
  const double r2 = circle.radius * circle.radius;
  const double area = std::numbers::pi * r2;
  return {area, circle.center, 0.5 * area * r2};
}

/// Sums the triangles that a fan from the first vertex makes.
AreaProperties areaOf(const Polygon& polygon) {
  const std::vector<Vec2>& v = polygon.vertices;
  double twice_area = 0.0;
  double moment = 0.0;  // polar, about the first vertex
  Vec2 weighted = Vec2::Zero();
  for (std::size_t i = 1; i + 1 < v.size(); ++i) {
    const Vec2 p = v[i] - v[0];
    const Vec2 q = v[i + 1] - v[0];
    const double twice = cross(p, q);
    twice_area += twice;
    weighted += twice / 3.0 * (p + q);
    moment += twice / 12.0 * (p.dot(p) + p.dot(q) + q.dot(q));
  }
  if (twice_area == 0.0) return {};
  const Vec2 centroid = weighted / twice_area;
  const double area = 0.5 * twice_area;
  return {area, v[0] + centroid, moment - area * centroid.squaredNorm()};
}

}  // namespace

AreaProperties areaProperties(const ConvexShape& shape) {
  return std::visit([](const auto& s) { return areaOf(s); }, shape);
}

AreaProperties areaProperties(const std::vector<ConvexShape>& shapes) {
  AreaProperties sum;
  for (const ConvexShape& shape : shapes) {
    const AreaProperties part = areaProperties(shape);
    const double area = sum.area + part.area;
    if (area == 0.0) continue;
    // Both parts' moments move to the common centroid, which cuts the line between them by area.
    const Vec2 apart = part.centroid - sum.centroid;
    sum.secondMoment += part.secondMoment + sum.area * part.area / area * apart.squaredNorm();
    sum.centroid += part.area / area * apart;
    sum.area = area;
  }
  return sum;
}

}  // namespace merge2d
