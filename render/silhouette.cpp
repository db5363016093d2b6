#include "render/silhouette.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace merge2d {
namespace {

using Outline = std::vector<Vec2>;
using Interval = std::pair<double, double>;  // of an edge, in [0, 1]

/// A rectangle as such, for it is cheaper to draw.
bool isRectangle(const Outline& v) {
  if (v.size() != 4) return false;
  const Vec2 a = v[1] - v[0], b = v[2] - v[1];
  const double tolerance = 1e-9 * (a.norm() + b.norm());
  return std::abs(a.dot(b)) <= tolerance * std::max(a.norm(), b.norm()) &&
         (v[0] + v[2] - v[1] - v[3]).norm() <= tolerance;
}

Piece polygonPiece(const Outline& v) {
  Piece piece{.kind = Piece::Kind::Polygon, .vertices = v};
  Aabb box;
  for (const Vec2& p : v) box.include(p);
  piece.frame.position = box.center();
  if (isRectangle(v)) {
    const Vec2 a = v[1] - v[0], b = v[2] - v[1];
    piece.kind = Piece::Kind::Box;
    piece.frame = {0.5 * (v[0] + v[2]), {a.x() / a.norm(), a.y() / a.norm()}};
    piece.half = 0.5 * Vec2(a.norm(), b.norm());
  }
  for (const Vec2& p : v) {
    piece.radius = std::max(piece.radius, (p - piece.frame.position).norm());
  }
  return piece;
}

Piece makePiece(const ConvexShape& shape) {
  if (const auto* polygon = std::get_if<Polygon>(&shape)) return polygonPiece(polygon->vertices);
  const auto& circle = std::get<Circle>(shape);
  return {.kind = Piece::Kind::Disc, .frame = {circle.center, {}}, .radius = circle.radius};
}

/// The piece as a polygon; a disc with so many corners that none can be seen.
Outline outlineOf(const Piece& piece) {
  if (piece.kind != Piece::Kind::Disc) return piece.vertices;
  constexpr int kCorners = 48;
  Outline out;
  for (int i = 0; i < kCorners; ++i) {
    const Rotation turn = Rotation::of(2.0 * std::numbers::pi * i / kCorners);
    out.push_back(piece.frame.position + turn * Vec2(piece.radius, 0.0));
  }
  return out;
}

/// The part of the edge a–b inside of a convex outline that is grown by `slack`, or nothing (an
/// empty interval): Cyrus and Beck's clipping.
Interval covered(const Vec2& a, const Vec2& b, const Outline& by, double slack, bool yields) {
  const Vec2 along = b - a;
  Interval part{0.0, 1.0};
  for (std::size_t i = 0; i < by.size(); ++i) {
    const Vec2 edge = by[(i + 1) % by.size()] - by[i];
    const Vec2 outward = -perpendicular(edge).normalized();
    const double start = outward.dot(a - by[i]), slope = outward.dot(along);
    const bool flush = std::abs(start) <= slack && std::abs(start + slope) <= slack;
    // Two edges that run together in one direction are both outside: one of them stays.
    if (flush && edge.dot(along) > 0.0 && !yields) return {0.0, 0.0};
    if (flush) continue;
    if (std::abs(slope) < 1e-300) {
      if (start > slack) return {0.0, 0.0};
    } else {
      const double t = (slack - start) / slope;
      (slope > 0.0 ? part.second : part.first) =
          slope > 0.0 ? std::min(part.second, t) : std::max(part.first, t);
    }
  }
  return part.first < part.second ? part : Interval{0.0, 0.0};
}

/// Adds what the intervals leave of the edge a–b.
void addRest(std::vector<Segment>& out, const Vec2& a, const Vec2& b, std::vector<Interval>& hidden,
             double slack) {
  std::ranges::sort(hidden);
  hidden.emplace_back(1.0, 1.0);
  double at = 0.0;
  for (const auto& [from, to] : hidden) {
    if ((from - at) * (b - a).norm() > 4.0 * slack) {
      out.push_back({a + at * (b - a), a + from * (b - a)});
    }
    at = std::max(at, to);
  }
}

/// Segments that go on in the same direction become one: where two ends met, a dot would show.
std::vector<Segment> joined(std::vector<Segment> segments, double slack) {
  const double near = 8.0 * slack;
  const auto goesOn = [&](const Segment& s, const Segment& next) {
    const Vec2 a = s.to - s.from, b = next.to - next.from;
    return (next.from - s.to).norm() <= near && a.dot(b) > 0.0 &&
           std::abs(cross(a, b)) <= 1e-6 * a.norm() * b.norm();
  };
  const auto start = [](const Segment& s) { return s.from.x(); };
  std::ranges::sort(segments, {}, start);

  constexpr std::size_t kNoSegment = static_cast<std::size_t>(-1);
  std::vector<std::size_t> next(segments.size(), kNoSegment);
  std::vector<bool> continues(segments.size(), false);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const double x = segments[i].to.x();
    const auto first = std::ranges::lower_bound(segments, x - near, {}, start);
    for (auto it = first; it != segments.end() && start(*it) <= x + near; ++it) {
      const auto j = static_cast<std::size_t>(it - segments.begin());
      if (continues[j] || !goesOn(segments[i], *it)) continue;
      next[i] = j;
      continues[j] = true;
      break;
    }
  }
  std::vector<Segment> out;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (continues[i]) continue;
    std::size_t last = i;
    while (next[last] != kNoSegment) last = next[last];
    out.push_back({segments[i].from, segments[last].to});
  }
  return out;
}

std::vector<Segment> boundaryOf(const std::vector<Piece>& pieces, double slack) {
  std::vector<Outline> outlines;
  std::vector<Aabb> boxes;
  for (const Piece& piece : pieces) {
    outlines.push_back(outlineOf(piece));
    boxes.emplace_back();
    for (const Vec2& p : outlines.back()) boxes.back().include(p);
  }
  std::vector<Segment> out;
  std::vector<std::size_t> near;
  std::vector<Interval> hidden;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    near.clear();
    for (std::size_t j = 0; j < pieces.size(); ++j) {
      if (j != i && boxes[j].grown(slack).overlaps(boxes[i])) near.push_back(j);
    }
    const Outline& mine = outlines[i];
    for (std::size_t e = 0; e < mine.size(); ++e) {
      const Vec2 &a = mine[e], &b = mine[(e + 1) % mine.size()];
      hidden.clear();
      for (const std::size_t j : near) {
        const Interval part = covered(a, b, outlines[j], slack, j < i);
        if (part.first < part.second) hidden.push_back(part);
      }
      addRest(out, a, b, hidden, slack);
    }
  }
  return joined(std::move(out), slack);
}

}  // namespace

Silhouette silhouette(const std::vector<ConvexShape>& shapes) {
  Silhouette out;
  double thinnest = 1e300;
  Aabb box;
  for (const ConvexShape& shape : shapes) {
    const Piece& piece = out.pieces.emplace_back(makePiece(shape));
    out.radius = std::max(out.radius, piece.frame.position.norm() + piece.radius);
    const Vec2 half = tightBox(outlinePoints(shape)).half;
    thinnest = std::min(thinnest, 2.0 * half.minCoeff());
    box.include(bounds(shape));
    out.area += areaProperties(shape).area;
  }
  out.width = shapes.size() == 1 ? thinnest : box.empty() ? 0.0 : box.extent().minCoeff();
  if (shapes.size() > 1) out.boundary = boundaryOf(out.pieces, 1e-4 * thinnest);
  return out;
}

BodyLooks::BodyLooks(const std::vector<BodyInfo>& bodies) {
  std::vector<double> widths;
  silhouettes.reserve(bodies.size());
  for (const BodyInfo& body : bodies) {
    silhouettes.push_back(silhouette(body.shapes));
    if (body.motion == Motion::Dynamic) widths.push_back(silhouettes.back().width);
  }
  if (widths.empty()) return;
  const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
  std::nth_element(widths.begin(), middle, widths.end());
  typical_width = *middle;
}

}  // namespace merge2d
