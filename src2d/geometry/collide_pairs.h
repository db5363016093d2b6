#pragma once
/// The kinds of pairs that collide() tells apart, and what they share. Not for other folders.

#include <box2d/b2_collision.h>

#include "src2d/geometry/collide.h"

namespace merge2d {

Manifold collidePolygons(const Collider& a, const Collider& b, const Pose& b_in_a, double margin,
                         FaceMemory& memory);

/// A polygon and a disc whose centre is given in the polygon's body frame.
Manifold collidePolygonAndDisc(const Collider& polygon, const Vec2& center, double radius,
                               double margin);

Manifold collideDiscs(const Vec2& a, double radius_a, const Vec2& b, double radius_b,
                      double margin);

/// Box2D looks this much farther than asked, so that its rounding loses no point; those beyond the
/// margin are dropped in double. [m]
inline constexpr float kFloatSlack = 1e-5F;

inline b2Vec2 toFloat(const Vec2& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y())};
}

inline b2Transform identity() {
  b2Transform xf;
  xf.SetIdentity();
  return xf;
}

/// Which face Box2D means: it gives the middle of the face, computed from the same floats.
inline int faceWithMiddle(const b2PolygonShape& polygon, const b2Vec2& middle) {
  int best = 0;
  float least = b2_maxFloat;
  for (int i = 0; i < polygon.m_count; ++i) {
    const int next = i + 1 < polygon.m_count ? i + 1 : 0;
    const b2Vec2 here = 0.5F * (polygon.m_vertices[i] + polygon.m_vertices[next]);
    const float distance = b2DistanceSquared(here, middle);
    if (distance < least) {
      least = distance;
      best = i;
    }
  }
  return best;
}

inline void addPoint(Manifold& m, const Vec2& middle, double gap, std::uint32_t feature) {
  m.points[static_cast<std::size_t>(m.count++)] = {middle, gap, feature};
}

}  // namespace merge2d
