/// The reference face is found as Box2D 2.4.1 does, by separating axes, in float and relative to
/// A's centre (reference_face.h). The incident edge is then cut to the width of that face in
/// double, from the exact vertices:
///
///              incident edge                 n
///        \________________________          ^
///         x      gaps            x          |
///   begin ------------------------ end   reference face
///
/// Deviations from b2CollidePolygons: the edge is cut at the face's very ends rather than a margin
/// beyond them, so that nothing rests on air; corner against corner gets the normal between the
/// corners, as in Box2D v3, or that of the face that parts them best where they are in one place;
/// features name the two faces and the end, so that a point keeps its name when the reference face
/// changes sides or a corner slides over an end.

#include <algorithm>
#include <limits>
#include <utility>

#include "src2d/geometry/collide_pairs.h"
#include "src2d/geometry/reference_face.h"

namespace merge2d {

namespace {

// Faces that overlap by less than this meet at corners only. [m]
constexpr double kCornerWidth = 1e-5;
// Below this distance the direction between two corners says nothing; above it a corner that is
// nearer than the faces matters. [m]
constexpr double kCornerDistance = 5e-4;
// Corners in one place overlap truly when the faces do by more than this. [m]
constexpr double kCornerOverlap = 1e-4;

/// Both, with B's pose seen from A.
struct Polygons {
  const Collider& a;
  const Collider& b;
  const Pose& b_in_a;
};

struct Edge {
  Vec2 begin, end;
};

/// The reference face and the face of the other polygon that looks at it, in A's frame.
struct FacePair {
  Edge reference, incident;
  Vec2 normal;          // of the reference face
  std::uint32_t faces;  // A's and B's, as the lower half of the features' names
  bool swapped;         // the reference face is B's

  Vec2 normalFromA() const { return swapped ? Vec2(-normal) : normal; }
  /// Ends are counted along the reference face, in names along A's.
  std::uint32_t feature(int end) const {
    return faces | static_cast<std::uint32_t>(swapped ? 1 - end : end) << 16U;
  }
  double height(const Vec2& p) const { return normal.dot(p - reference.begin); }
};

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

/// Box2D's reference face, for points up to `margin` apart.
ReferenceFace findReference(const Polygons& polygons, double margin, FaceMemory& memory) {
  const auto& [a, b, b_in_a] = polygons;
  b2Transform xf;
  xf.p = toFloat(b_in_a.exactly(b.origin()) - a.origin());
  xf.q.s = static_cast<float>(b_in_a.rotation.s);
  xf.q.c = static_cast<float>(b_in_a.rotation.c);
  const float radius_b = b.polygon().m_radius;
  const bool usual = static_cast<float>(margin) == Collider::kUsualMargin;
  const float radius_a =
      usual ? a.polygon().m_radius : static_cast<float>(margin) + kFloatSlack - radius_b;
  return referenceFace(a, b, xf, radius_a + radius_b, memory);
}

FacePair facePair(const ReferenceFace& reference, const Polygons& polygons) {
  const auto& [a, b, b_in_a] = polygons;
  FacePair pair;
  pair.swapped = reference.swapped;
  int face_a = reference.face;
  int face_b = reference.face;
  if (pair.swapped) {
    pair.normal = b_in_a.rotation * b.normal(face_b);
    face_a = faceAgainst(a, pair.normal);
  } else {
    pair.normal = a.normal(face_a);
    face_b = faceAgainst(b, b_in_a.rotation.inverse() * pair.normal);
  }
  pair.reference = {a.vertex(face_a), a.vertex(a.next(face_a))};
  pair.incident = {b_in_a.exactly(b.vertex(face_b)), b_in_a.exactly(b.vertex(b.next(face_b)))};
  if (pair.swapped) std::swap(pair.reference, pair.incident);
  pair.faces = static_cast<std::uint32_t>(face_a | face_b << 8);
  return pair;
}

/// A face of one polygon, and how far the other one is in front of it.
struct Separation {
  double gap = -std::numeric_limits<double>::infinity();
  Vec2 normal = Vec2::Zero();   // of the face, outward
  Vec2 deepest = Vec2::Zero();  // the other polygon's vertex
};

Separation separationFrom(const Collider& a, int face, const Collider& b, const Pose& b_in_a) {
  const auto height = [&](const Vec2& p) { return a.normal(face).dot(p - a.vertex(face)); };
  Vec2 deepest = b_in_a.exactly(b.vertex(0));
  for (int i = 1; i < b.count(); ++i) {
    const Vec2 p = b_in_a.exactly(b.vertex(i));
    if (height(p) < height(deepest)) deepest = p;
  }
  return {height(deepest), a.normal(face), deepest};
}

/// From the face of `a` that parts it from `b` best; all in the frame of `a`.
Separation largestSeparation(const Collider& a, const Collider& b, const Pose& b_in_a) {
  Separation best;
  for (int i = 0; i < a.count(); ++i) {
    const Separation here = separationFrom(a, i, b, b_in_a);
    if (here.gap > best.gap) best = here;
  }
  return best;
}

/// Corners in one place have no direction between them, but neither do they bear on each other
/// unless the polygons overlap. Box2D's tolerance of 0.5 mm may have preferred a face that does not
/// part them best, so all faces are asked again, in double.
Manifold cornersInOnePlace(const Polygons& polygons, std::uint32_t feature) {
  const auto& [a, b, b_in_a] = polygons;
  Separation best = largestSeparation(a, b, b_in_a);
  const Separation other = largestSeparation(b, a, b_in_a.inverse());
  Vec2 from_a = best.normal;
  if (other.gap > best.gap) {
    best = {other.gap, b_in_a.rotation * other.normal, b_in_a.exactly(other.deepest)};
    from_a = -best.normal;
  }
  Manifold m;
  if (best.gap >= -kCornerOverlap) return m;
  m.normal = from_a;
  addPoint(m, best.deepest - 0.5 * best.gap * best.normal, best.gap, feature);
  return m;
}

/// The contact of a corner at one end of the reference face with the incident edge, which is beside
/// the face.
Manifold cornerContact(const Polygons& polygons, const FacePair& pair, int end, double margin) {
  const Vec2& corner = end == 1 ? pair.reference.end : pair.reference.begin;
  const Vec2 along = pair.incident.end - pair.incident.begin;
  const double t = along.dot(corner - pair.incident.begin) / along.squaredNorm();
  const Vec2 nearest = pair.incident.begin + std::clamp(t, 0.0, 1.0) * along;
  const Vec2 d = nearest - corner;
  const double distance = d.norm();
  if (distance <= kCornerDistance) return cornersInOnePlace(polygons, pair.feature(end));
  Manifold m;
  const double height = pair.height(nearest);
  constexpr double kStraight = 0.9;  // cosine: beyond, the corner lies before or behind the edge
  if (height < -kCornerDistance || -height > kStraight * distance) {
    // a true overlap: only the face's own direction ends it
    m.normal = pair.normalFromA();
    addPoint(m, nearest - 0.5 * height * pair.normal, height, pair.feature(end));
  } else if (distance <= margin) {
    m.normal = (pair.swapped ? -1.0 : 1.0) / distance * d;
    addPoint(m, corner + 0.5 * d, distance, pair.feature(end));
  }
  return m;
}

/// Cuts the incident edge to the width of the reference face.
Manifold clippedContact(const Polygons& polygons, const FacePair& pair, double margin) {
  // Positions along the face, from its beginning; the incident edge runs the other way.
  const Vec2 tangent = perpendicular(pair.normal);
  const double length = tangent.dot(pair.reference.end - pair.reference.begin);
  const std::array<Vec2, 2> vertices = {pair.incident.end, pair.incident.begin};
  const double low = tangent.dot(vertices[0] - pair.reference.begin);
  const double high = tangent.dot(vertices[1] - pair.reference.begin);
  const double width = std::min(high, length) - std::max(low, 0.0);
  if (width < kCornerWidth) {
    return cornerContact(polygons, pair, low + high > length ? 1 : 0, margin);
  }
  std::array<Vec2, 2> ends = vertices;
  const Vec2 along = (vertices[1] - vertices[0]) / (high - low);
  if (low < 0.0) ends[0] -= low * along;
  if (high > length) ends[1] -= (high - length) * along;
  const std::array<double, 2> gaps = {pair.height(ends[0]), pair.height(ends[1])};

  // A steep edge that starts beside the face may be nearest to the face's corner.
  const std::size_t lower = gaps[0] < gaps[1] ? 0 : 1;
  const Vec2& corner = lower == 0 ? pair.reference.begin : pair.reference.end;
  if (pair.height(vertices[lower]) > 0.0 &&
      gaps[lower] > (vertices[lower] - corner).norm() + kCornerDistance) {
    return cornerContact(polygons, pair, static_cast<int>(lower), margin);
  }

  Manifold m;
  m.normal = pair.normalFromA();
  for (const std::size_t i : {pair.swapped ? 1U : 0U, pair.swapped ? 0U : 1U}) {
    if (gaps[i] > margin) continue;
    addPoint(m, ends[i] - 0.5 * gaps[i] * pair.normal, gaps[i], pair.feature(static_cast<int>(i)));
  }
  return m;
}

}  // namespace

Manifold collidePolygons(const Collider& a, const Collider& b, const Pose& b_in_a, double margin,
                         FaceMemory& memory) {
  const Polygons polygons{a, b, b_in_a};
  const ReferenceFace reference = findReference(polygons, margin, memory);
  if (!reference.found) return {};
  return clippedContact(polygons, facePair(reference, polygons), margin);
}

}  // namespace merge2d
