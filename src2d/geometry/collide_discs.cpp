/// Discs against discs and polygons. Box2D finds the nearest feature of a polygon; the rest is
/// exact.

#include "src2d/geometry/collide_pairs.h"

namespace merge2d {

namespace {

// Below this distance the direction from a corner to a disc's centre says nothing. [m]
constexpr double kCenterDistance = 1e-6;

/// `from` and `to` are centres and the radii may be 0.
Manifold roundContact(const Vec2& from, double from_radius, const Vec2& to, double to_radius,
                      const Vec2& fallback, double least_distance, double margin) {
  Manifold m;
  const Vec2 d = to - from;
  const double distance = d.norm();
  const double gap = distance - from_radius - to_radius;
  if (gap > margin) return m;
  m.normal = distance > least_distance ? Vec2(d / distance) : fallback;
  addPoint(m, from + (from_radius + 0.5 * gap) * m.normal, gap, 0);
  return m;
}

}  // namespace

Manifold collidePolygonAndDisc(const Collider& polygon, const Vec2& center, double radius,
                               double margin) {
  const b2PolygonShape& shape = polygon.polygon();
  b2CircleShape disc;  // Box2D looks at the sum of the radii only
  disc.m_p = toFloat(center - polygon.origin());
  disc.m_radius = static_cast<float>(radius + margin) + kFloatSlack - shape.m_radius;
  b2Manifold found;
  b2CollidePolygonAndCircle(&found, &shape, identity(), &disc, identity());
  if (found.pointCount == 0) return {};

  // A corner is nearest: Box2D hands its vertex back as it is.
  for (int i = 0; i < polygon.count(); ++i) {
    if (!(shape.m_vertices[i] == found.localPoint)) continue;
    const int before = i > 0 ? i - 1 : polygon.count() - 1;
    const Vec2 outward = (polygon.normal(before) + polygon.normal(i)).normalized();
    return roundContact(polygon.vertex(i), 0.0, center, radius, outward, kCenterDistance, margin);
  }

  // A face is nearest, or the centre lies inside.
  Manifold m;
  const int face = faceWithMiddle(shape, found.localPoint);
  m.normal = polygon.normal(face);
  const double height = m.normal.dot(center - polygon.vertex(face));
  const double gap = height - radius;
  if (gap <= margin) addPoint(m, center - 0.5 * (height + radius) * m.normal, gap, 0);
  return m;
}

Manifold collideDiscs(const Vec2& a, double radius_a, const Vec2& b, double radius_b,
                      double margin) {
  return roundContact(a, radius_a, b, radius_b, Vec2::UnitX(), 0.0, margin);
}

}  // namespace merge2d
