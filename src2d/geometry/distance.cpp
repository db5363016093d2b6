/// By brute force over the vertices of one and the edges of the other: both have eight at most.

#include "src2d/geometry/distance.h"

#include <algorithm>

namespace merge2d {
namespace {

/// The core of a shape, without its radius: vertices in the frame of A; a disc has one.
struct Core {
  std::array<Vec2, Polygon::kMaxVertices> vertices;
  std::size_t count = 0;

  Core(const Collider& shape, const Pose& pose)
      : count(shape.isCircle() ? 1 : static_cast<std::size_t>(shape.count())) {
    if (shape.isCircle()) {
      vertices[0] = pose.exactly(shape.origin());
      return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      vertices[i] = pose.exactly(shape.vertex(static_cast<int>(i)));
    }
  }
};

Vec2 nearestOfEdge(const Vec2& p, const Vec2& begin, const Vec2& end) {
  const Vec2 along = end - begin;
  const double squared = along.squaredNorm();
  if (squared == 0.0) return begin;
  return begin + std::clamp(along.dot(p - begin) / squared, 0.0, 1.0) * along;
}

/// The shortest way from an edge of `edges` to a vertex of `points`. Of a polygon only the edges
/// that look at the vertex matter. False when no edge has all vertices before it.
bool shortestWay(const Core& edges, const Core& points, double sign, double& least, Vec2& way) {
  bool apart = edges.count < 3;
  for (std::size_t i = 0; i < edges.count; ++i) {
    const Vec2 &begin = edges.vertices[i], &end = edges.vertices[i + 1 < edges.count ? i + 1 : 0];
    const Vec2 outward = -perpendicular(end - begin);
    bool all = true;
    for (std::size_t j = 0; j < points.count; ++j) {
      const Vec2& p = points.vertices[j];
      if (edges.count > 2 && outward.dot(p - begin) <= 0.0) {
        all = false;
        continue;
      }
      const Vec2 d = p - nearestOfEdge(p, begin, end);
      if (d.squaredNorm() >= least) continue;
      least = d.squaredNorm();
      way = sign * d;
    }
    apart |= all;
  }
  return apart;
}

}  // namespace

Nearest nearest(const Collider& a, const Collider& b, const Pose& b_in_a) {
  const Core core_a(a, {}), core_b(b, b_in_a);
  double least = 1e300;
  Vec2 way = Vec2::Zero();
  const bool before_a = shortestWay(core_a, core_b, 1.0, least, way);
  const bool before_b = shortestWay(core_b, core_a, -1.0, least, way);
  // The core of a disc is a point, which has no inside.
  const bool round_a = core_a.count == 1, round_b = core_b.count == 1;
  const bool apart = (round_a && round_b) || (before_a && !round_a) || (before_b && !round_b);
  if (!apart) return {};
  const double length = std::sqrt(least);
  const double distance = length - a.radius() - b.radius();
  if (length == 0.0 || distance <= 0.0) return {};
  return {distance, way / length};
}

double reachFrom(const Collider& shape, const Vec2& center) {
  if (shape.isCircle()) return (shape.origin() - center).norm();
  double farthest = 0.0;
  for (int i = 0; i < shape.count(); ++i) {
    farthest = std::max(farthest, (shape.vertex(i) - center).squaredNorm());
  }
  return std::sqrt(farthest);
}

}  // namespace merge2d
