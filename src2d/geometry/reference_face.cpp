#include "src2d/geometry/reference_face.h"

#include <array>

#include "src2d/geometry/collide_pairs.h"

namespace merge2d {
namespace {

/// Of four faces or vertices side by side.
using FourFloats = float __attribute__((vector_size(16)));

struct FourPoints {
  FourFloats x, y;
};

/// Vectors `first` to `first` + 3; those beyond a polygon's last are of no meaning.
FourPoints loadPoints(const b2Vec2* all, int first) {
  static_assert(b2_maxPolygonVertices % 4 == 0);
  FourPoints p{};
  for (int i = 0; i < 4; ++i) {
    p.x[i] = all[first + i].x;
    p.y[i] = all[first + i].y;
  }
  return p;
}

/// The face of a polygon that is farthest in front of another one.
struct BestFace {
  int index = 0;
  float separation = -b2_maxFloat;
};

/// b2FindMaxSeparation; `xf` leads from the frame of `one` to that of `other`.
BestFace bestFace(const b2PolygonShape& one, const b2PolygonShape& other, const b2Transform& xf) {
  BestFace best;
  for (int first = 0; first < one.m_count; first += 4) {
    const FourPoints n = loadPoints(one.m_normals, first), v = loadPoints(one.m_vertices, first);
    const FourFloats nx = xf.q.c * n.x - xf.q.s * n.y, ny = xf.q.s * n.x + xf.q.c * n.y;
    const FourFloats vx = (xf.q.c * v.x - xf.q.s * v.y) + xf.p.x;
    const FourFloats vy = (xf.q.s * v.x + xf.q.c * v.y) + xf.p.y;
    FourFloats least = FourFloats{} + b2_maxFloat;
    for (int j = 0; j < other.m_count; ++j) {
      const b2Vec2& w = other.m_vertices[j];
      const FourFloats height = nx * (w.x - vx) + ny * (w.y - vy);
      least = height < least ? height : least;
    }
    for (int i = 0; i < 4 && first + i < one.m_count; ++i) {
      if (least[i] > best.separation) best = {first + i, least[i]};
    }
  }
  return best;
}

using Segment = std::array<b2Vec2, 2>;

/// b2FindIncidentEdge: the face of `other` that looks against the normal of a face of `one`.
Segment incidentEdge(const b2PolygonShape& one, const b2Transform& xf_one, int face,
                     const b2PolygonShape& other, const b2Transform& xf_other) {
  const b2Vec2 normal = b2MulT(xf_other.q, b2Mul(xf_one.q, one.m_normals[face]));
  int index = 0;
  float least = b2_maxFloat;
  for (int i = 0; i < other.m_count; ++i) {
    const float along = b2Dot(normal, other.m_normals[i]);
    if (along < least) least = along, index = i;
  }
  const int next = index + 1 < other.m_count ? index + 1 : 0;
  return {b2Mul(xf_other, other.m_vertices[index]), b2Mul(xf_other, other.m_vertices[next])};
}

/// b2ClipSegmentToLine. False when less than a segment is left.
bool clip(Segment& segment, const b2Vec2& normal, float offset) {
  const Segment in = segment;
  const float d0 = b2Dot(normal, in[0]) - offset, d1 = b2Dot(normal, in[1]) - offset;
  std::size_t count = 0;
  if (d0 <= 0.0F) segment[count++] = in[0];
  if (d1 <= 0.0F) segment[count++] = in[1];
  if (d0 * d1 < 0.0F) segment[count++] = in[0] + d0 / (d0 - d1) * (in[1] - in[0]);
  return count == 2;
}

/// True where the incident edge, cut to the width of the face and `radius` more, is near the face.
bool isNear(const b2PolygonShape& one, const b2Transform& xf, int face, Segment edge,
            float radius) {
  const int next = face + 1 < one.m_count ? face + 1 : 0;
  b2Vec2 local_tangent = one.m_vertices[next] - one.m_vertices[face];
  local_tangent.Normalize();
  const b2Vec2 tangent = b2Mul(xf.q, local_tangent), normal = b2Cross(tangent, 1.0F);
  const b2Vec2 begin = b2Mul(xf, one.m_vertices[face]), end = b2Mul(xf, one.m_vertices[next]);
  const float front = b2Dot(normal, begin) + radius;
  const float side_begin = -b2Dot(tangent, begin) + radius, side_end = b2Dot(tangent, end) + radius;
  // Mostly one end is, and stays when the edge is cut.
  const auto staysNear = [&](const b2Vec2& p) {
    constexpr float kWell = 1e-6F;
    const float along = b2Dot(tangent, p);
    return -along < side_begin - kWell && along < side_end - kWell &&
           b2Dot(normal, p) < front - kWell;
  };
  if (staysNear(edge[0]) || staysNear(edge[1])) return true;
  if (!clip(edge, -tangent, side_begin) || !clip(edge, tangent, side_end)) return false;
  const auto isLow = [&](const b2Vec2& p) {
    return b2Dot(normal, p) - b2Dot(normal, begin) <= radius;
  };
  return isLow(edge[0]) || isLow(edge[1]);
}

}  // namespace

ReferenceFace referenceFace(const b2PolygonShape& a, const b2PolygonShape& b,
                            const b2Transform& b_in_a, float radius) {
  const b2Transform a_in_a = identity();
  const BestFace of_a = bestFace(a, b, b2MulT(b_in_a, a_in_a));
  if (of_a.separation > radius) return {};
  const BestFace of_b = bestFace(b, a, b2MulT(a_in_a, b_in_a));
  if (of_b.separation > radius) return {};
  constexpr float kTolerance = 0.1F * b2_linearSlop;
  if (of_b.separation > of_a.separation + kTolerance) {
    const Segment edge = incidentEdge(b, b_in_a, of_b.index, a, a_in_a);
    return {isNear(b, b_in_a, of_b.index, edge, radius), true, of_b.index};
  }
  const Segment edge = incidentEdge(a, a_in_a, of_a.index, b, b_in_a);
  return {isNear(a, a_in_a, of_a.index, edge, radius), false, of_a.index};
}

}  // namespace merge2d
