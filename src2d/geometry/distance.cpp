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

/// The shortest way from an edge of `edges` to a vertex of `points`.
void shortestWay(const Core& edges, const Core& points, double sign, double& least, Vec2& way) {
  for (std::size_t i = 0; i < edges.count; ++i) {
    const Vec2 &begin = edges.vertices[i], &end = edges.vertices[(i + 1) % edges.count];
    for (std::size_t j = 0; j < points.count; ++j) {
      const Vec2 d = points.vertices[j] - nearestOfEdge(points.vertices[j], begin, end);
      if (d.squaredNorm() >= least) continue;
      least = d.squaredNorm();
      way = sign * d;
    }
  }
}

/// True when some face of `a` has all of `b` before it.
bool hasSeparatingFace(const Core& a, const Core& b) {
  for (std::size_t i = 0; i < a.count && a.count > 2; ++i) {
    const Vec2 &begin = a.vertices[i], &end = a.vertices[(i + 1) % a.count];
    const Vec2 outward = -perpendicular(end - begin);
    const auto before = [&](const Vec2& p) { return outward.dot(p - begin) > 0.0; };
    if (std::all_of(b.vertices.begin(), b.vertices.begin() + static_cast<std::ptrdiff_t>(b.count),
                    before)) {
      return true;
    }
  }
  return false;
}

}  // namespace

Nearest nearest(const Collider& a, const Collider& b, const Pose& b_in_a) {
  const Core core_a(a, {}), core_b(b, b_in_a);
  const bool points = core_a.count == 1 && core_b.count == 1;
  if (!points && !hasSeparatingFace(core_a, core_b) && !hasSeparatingFace(core_b, core_a)) {
    return {};
  }
  double least = 1e300;
  Vec2 way = Vec2::Zero();
  shortestWay(core_a, core_b, 1.0, least, way);
  shortestWay(core_b, core_a, -1.0, least, way);
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
