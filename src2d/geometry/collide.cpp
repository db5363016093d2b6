/// Box2D 2.4.1 finds the reference face by separating axes, in float and relative to A's centre.
/// The incident edge is then cut to the width of that face in double, from the exact vertices:
///
///              incident edge                 n
///        \________________________          ^
///         x      gaps            x          |
///   begin ------------------------ end   reference face
///
/// Deviations from b2CollidePolygons: the edge is cut at the face's very ends rather than a margin
/// beyond them, so that nothing rests on air; corner against corner gets the normal between the
/// corners, as in Box2D v3; features name the two faces and the end, so that a point keeps its
/// name when the reference face changes sides or a corner slides over an end.

#include "src2d/geometry/collide.h"

#include <box2d/b2_collision.h>

#include <algorithm>

namespace merge2d {

namespace {

// Faces that overlap by less than this meet at corners only. [m]
constexpr double kCornerWidth = 1e-5;
// Below this distance the direction between two corners says nothing. [m]
constexpr double kCornerDistance = 5e-4;
// Below this distance the direction from a corner to a disc's centre says nothing. [m]
constexpr double kCenterDistance = 1e-6;

b2Vec2 toFloat(const Vec2& v) { return {static_cast<float>(v.x()), static_cast<float>(v.y())}; }

b2Transform identity() {
  b2Transform xf;
  xf.SetIdentity();
  return xf;
}

/// Which face Box2D means: it gives the middle of the face, computed from the same floats.
int faceWithMiddle(const b2PolygonShape& polygon, const b2Vec2& middle) {
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

/// The face whose normal is most opposed to `direction`, which is in the collider's body frame.
int faceAgainst(const Collider& collider, const Vec2& direction) {
  int best = 0;
  double least = collider.normal(0).dot(direction);
  for (int i = 1; i < collider.count(); ++i) {
    const double along = collider.normal(i).dot(direction);
    if (along < least) {
      least = along;
      best = i;
    }
  }
  return best;
}

struct Edge {
  Vec2 begin, end;
};

void add(Manifold& m, const Vec2& middle, double gap, std::uint32_t feature) {
  m.points[static_cast<std::size_t>(m.count++)] = {middle, gap, feature};
}

// --- discs ------------------------------------------------------------------------------------

/// `from` and `to` are centres and the radii may be 0.
Manifold roundContact(const Vec2& from, double from_radius, const Vec2& to, double to_radius,
                      const Vec2& fallback, double least_distance, double margin) {
  Manifold m;
  const Vec2 d = to - from;
  const double distance = d.norm();
  const double gap = distance - from_radius - to_radius;
  if (gap > margin) return m;
  m.normal = distance > least_distance ? Vec2(d / distance) : fallback;
  add(m, from + (from_radius + 0.5 * gap) * m.normal, gap, 0);
  return m;
}

Manifold polygonAndDisc(const Collider& polygon, const Vec2& center, double radius, double margin) {
  const b2PolygonShape& shape = polygon.polygon();
  b2CircleShape disc;  // Box2D looks at the sum of the radii only
  disc.m_p = toFloat(center - polygon.origin());
  disc.m_radius = static_cast<float>(radius + margin) - shape.m_radius;
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
  if (gap <= margin) add(m, center - 0.5 * (height + radius) * m.normal, gap, 0);
  return m;
}

// --- polygons ---------------------------------------------------------------------------------

/// Box2D's manifold, for points up to `margin` apart. Only the sum of the two radii matters to it.
void findFaces(b2Manifold& found, const Collider& a, const Collider& b, const Pose& b_in_a,
               double margin) {
  b2Transform xf;
  xf.p = toFloat(b_in_a * b.origin() - a.origin());
  xf.q.s = static_cast<float>(b_in_a.rotation.s);
  xf.q.c = static_cast<float>(b_in_a.rotation.c);
  if (static_cast<float>(margin) == Collider::kUsualMargin) {
    b2CollidePolygons(&found, &a.polygon(), identity(), &b.polygon(), xf);
    return;
  }
  b2PolygonShape padded = a.polygon();
  padded.m_radius = static_cast<float>(margin) - b.polygon().m_radius;
  b2CollidePolygons(&found, &padded, identity(), &b.polygon(), xf);
}

/// The contact of the reference face's nearest corner with the incident edge beside the face.
void addCorner(Manifold& m, const Vec2& corner, const Edge& incident, double margin,
               std::uint32_t feature) {
  const Vec2 along = incident.end - incident.begin;
  const double t = along.dot(corner - incident.begin) / along.squaredNorm();
  const Vec2 nearest = incident.begin + std::clamp(t, 0.0, 1.0) * along;
  const Vec2 d = nearest - corner;
  const double height = m.normal.dot(d);
  const double distance = d.norm();
  if (distance <= kCornerDistance) return;
  if (height <= 0.0) {
    add(m, nearest - 0.5 * height * m.normal, height, feature);
  } else if (distance <= margin) {
    m.normal = d / distance;
    add(m, corner + 0.5 * d, distance, feature);
  }
}

/// Cuts the incident edge to the width of the reference face, whose normal `m` holds. `swapped`:
/// the reference face is B's, so its end is where A's face begins.
void addClipped(Manifold& m, const Edge& reference, const Edge& incident, double margin,
                std::uint32_t faces, bool swapped) {
  // Positions along the face; the incident edge runs the other way.
  const Vec2 tangent = perpendicular(m.normal);
  const double length = tangent.dot(reference.end - reference.begin);
  const double low = tangent.dot(incident.end - reference.begin);
  const double high = tangent.dot(incident.begin - reference.begin);
  const auto feature = [&](int end) { return faces | static_cast<std::uint32_t>(end) << 16U; };
  const int first = swapped ? 1 : 0;

  if (std::min(high, length) - std::max(low, 0.0) < kCornerWidth) {
    const bool at_end = low + high > length;
    addCorner(m, at_end ? reference.end : reference.begin, incident, margin,
              feature((at_end ? 1 : 0) ^ first));
    return;
  }

  const Vec2 along = (incident.begin - incident.end) / (high - low);
  std::array<Vec2, 2> ends = {incident.end, incident.begin};
  if (low < 0.0) ends[0] = incident.end - low * along;
  if (high > length) ends[1] = incident.begin - (high - length) * along;
  for (int i = 0; i < 2; ++i) {
    const Vec2& p = ends[static_cast<std::size_t>(i ^ first)];
    const double gap = m.normal.dot(p - reference.begin);
    if (gap <= margin) add(m, p - 0.5 * gap * m.normal, gap, feature(i));
  }
}

Manifold polygons(const Collider& a, const Collider& b, const Pose& b_in_a, double margin) {
  b2Manifold found;
  findFaces(found, a, b, b_in_a, margin);
  if (found.pointCount == 0) return {};

  // The two faces, and the reference face's normal in A's frame.
  Manifold m;
  const bool swapped = found.type == b2Manifold::e_faceB;
  int face_a = 0;
  int face_b = 0;
  if (swapped) {
    face_b = faceWithMiddle(b.polygon(), found.localPoint);
    m.normal = b_in_a.rotation * b.normal(face_b);
    face_a = faceAgainst(a, m.normal);
  } else {
    face_a = faceWithMiddle(a.polygon(), found.localPoint);
    m.normal = a.normal(face_a);
    face_b = faceAgainst(b, b_in_a.rotation.inverse() * m.normal);
  }
  const Edge edge_a = {a.vertex(face_a), a.vertex(a.next(face_a))};
  const Edge edge_b = {b_in_a * b.vertex(face_b), b_in_a * b.vertex(b.next(face_b))};
  const auto faces = static_cast<std::uint32_t>(face_a | face_b << 8);

  if (swapped) {
    addClipped(m, edge_b, edge_a, margin, faces, true);
    m.normal = -m.normal;
  } else {
    addClipped(m, edge_a, edge_b, margin, faces, false);
  }
  return m;
}

}  // namespace

Manifold collide(const Collider& a, const Collider& b, const Pose& b_in_a, double margin) {
  if (!a.isCircle() && !b.isCircle()) return polygons(a, b, b_in_a, margin);
  if (!a.isCircle()) return polygonAndDisc(a, b_in_a * b.origin(), b.radius(), margin);
  if (b.isCircle()) {
    return roundContact(a.origin(), a.radius(), b_in_a * b.origin(), b.radius(), Vec2::UnitX(), 0.0,
                        margin);
  }
  // The disc is A: look from B, then turn around.
  Manifold m = polygonAndDisc(b, b_in_a.toLocal(a.origin()), a.radius(), margin);
  m.normal = -(b_in_a.rotation * m.normal);
  for (ManifoldPoint& p : m.points) p.position = b_in_a * p.position;
  return m;
}

}  // namespace merge2d
