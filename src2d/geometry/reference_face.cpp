#include "src2d/geometry/reference_face.h"

#include <algorithm>
#include <array>
#include <cmath>

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
  float lead = 0.0F;  ///< over the second best [m]
};

/// b2FindMaxSeparation; `xf` leads from the frame of `one` to that of `other`.
BestFace bestFace(const b2PolygonShape& one, const b2PolygonShape& other, const b2Transform& xf) {
  BestFace best;
  float second = -b2_maxFloat;
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
      second = std::max(second, std::min(least[i], best.separation));
      if (least[i] > best.separation) best = {first + i, least[i]};
    }
  }
  best.lead = best.separation - second;
  return best;
}

using Segment = std::array<b2Vec2, 2>;

struct IncidentEdge {
  Segment ends;
  float lead = 0.0F;  ///< over the second that looks that way: of the cosines
};

/// b2FindIncidentEdge: the face of `other` that looks against the normal of a face of `one`.
IncidentEdge incidentEdge(const b2PolygonShape& one, const b2Transform& xf_one, int face,
                          const b2PolygonShape& other, const b2Transform& xf_other) {
  const b2Vec2 normal = b2MulT(xf_other.q, b2Mul(xf_one.q, one.m_normals[face]));
  int index = 0;
  float least = b2_maxFloat, second = b2_maxFloat;
  for (int i = 0; i < other.m_count; ++i) {
    const float along = b2Dot(normal, other.m_normals[i]);
    second = std::min(second, std::max(along, least));
    if (along < least) least = along, index = i;
  }
  const int next = index + 1 < other.m_count ? index + 1 : 0;
  return {{b2Mul(xf_other, other.m_vertices[index]), b2Mul(xf_other, other.m_vertices[next])},
          second - least};
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

/// Whether an incident edge is near a face, and how far each may move until it may be no longer.
struct Nearness {
  bool is_near = false;
  float by = 0.0F;  ///< [m]; 0 where that is not known
};

/// True where the incident edge, cut to the width of the face and `radius` more, is near the face.
Nearness nearness(const b2PolygonShape& one, const b2Transform& xf, int face, Segment edge,
                  float radius) {
  const int next = face + 1 < one.m_count ? face + 1 : 0;
  b2Vec2 local_tangent = one.m_vertices[next] - one.m_vertices[face];
  local_tangent.Normalize();
  const b2Vec2 tangent = b2Mul(xf.q, local_tangent), normal = b2Cross(tangent, 1.0F);
  const b2Vec2 begin = b2Mul(xf, one.m_vertices[face]), end = b2Mul(xf, one.m_vertices[next]);
  const float front = b2Dot(normal, begin) + radius;
  const float side_begin = -b2Dot(tangent, begin) + radius, side_end = b2Dot(tangent, end) + radius;
  // Mostly one end is, and stays when the edge is cut.
  const auto inside = [&](const b2Vec2& p) {
    const float along = b2Dot(tangent, p);
    return std::min({side_begin + along, side_end - along, front - b2Dot(normal, p)});
  };
  constexpr float kWell = 1e-6F;
  const float by = std::max(inside(edge[0]), inside(edge[1]));
  if (by > kWell) return {true, by};
  if (!clip(edge, -tangent, side_begin) || !clip(edge, tangent, side_end)) return {};
  const auto isLow = [&](const b2Vec2& p) {
    return b2Dot(normal, p) - b2Dot(normal, begin) <= radius;
  };
  return {isLow(edge[0]) || isLow(edge[1]), 0.0F};
}

/// Grows with the angle of a rotation, by half of it at least [rad].
float turnOf(const b2Rot& q) {
  const float part = q.s / (std::abs(q.c) + std::abs(q.s));
  return q.c < 0.0F ? std::copysign(2.0F, q.s) - part : part;
}

/// Bounds how far any corner of either polygon, seen from the other, has moved since then [m].
float motionSince(const FaceMemory& then, const b2Transform& now, float reach) {
  return std::abs(now.p.x - then.x) + std::abs(now.p.y - then.y) +
         2.0F * reach * std::abs(turnOf(now.q) - then.turn);
}

/// In whole micrometres, fewer rather than more.
std::uint16_t micrometres(float x) {
  return static_cast<std::uint16_t>(std::clamp(1e6F * x, 0.0F, 65535.0F));
}

/// A face that was sought, with how far corners may move while it stays the one.
struct Sought {
  ReferenceFace face;
  float room = 0.0F;  ///< [m]
};

Sought seekFace(const b2PolygonShape& a, const b2PolygonShape& b, const b2Transform& b_in_a,
                float radius, float reach) {
  const b2Transform a_in_a = identity();
  const BestFace of_a = bestFace(a, b, b2MulT(b_in_a, a_in_a));
  if (of_a.separation > radius) return {};
  const BestFace of_b = bestFace(b, a, b2MulT(a_in_a, b_in_a));
  if (of_b.separation > radius) return {};
  constexpr float kTolerance = 0.1F * b2_linearSlop;
  const float choice = of_b.separation - (of_a.separation + kTolerance);
  const bool swapped = choice > 0.0F;
  const BestFace& best = swapped ? of_b : of_a;
  const IncidentEdge edge = swapped ? incidentEdge(b, b_in_a, best.index, a, a_in_a)
                                    : incidentEdge(a, a_in_a, best.index, b, b_in_a);
  const Nearness near = swapped ? nearness(b, b_in_a, best.index, edge.ends, radius)
                                : nearness(a, a_in_a, best.index, edge.ends, radius);
  // Where two are compared both may change, each by as much as a corner moves.
  const float apart = radius - std::max(of_a.separation, of_b.separation);
  const float room = std::min(
      {0.5F * best.lead, 0.5F * std::abs(choice), apart, 0.5F * edge.lead * reach, near.by});
  return {{near.is_near, swapped, best.index}, room};
}

}  // namespace

ReferenceFace referenceFace(const Collider& a, const Collider& b, const b2Transform& b_in_a,
                            float radius, FaceMemory& memory) {
  constexpr float kRounding = 4e-6F;  // of all that is compared, as a part of the reach
  const float reach = std::max(b.size(), a.size() + std::abs(b_in_a.p.x) + std::abs(b_in_a.p.y));
  // The nearest that points are sought; a face that is found for these is for all others too.
  const float least = a.polygon().m_radius + b.polygon().m_radius;
  if (memory.holds > 0 && radius >= least &&
      motionSince(memory, b_in_a, reach) < 1e-6F * static_cast<float>(memory.holds)) {
    return {true, memory.swapped, memory.face};
  }
  const auto [face, room] = seekFace(a.polygon(), b.polygon(), b_in_a, radius, reach);
  memory = {};
  if (radius == least && face.found) {
    memory = {.x = b_in_a.p.x,
              .y = b_in_a.p.y,
              .turn = turnOf(b_in_a.q),
              .holds = micrometres(room - kRounding * reach),
              .face = static_cast<std::uint8_t>(face.face),
              .swapped = face.swapped};
  }
  return face;
}

}  // namespace merge2d
