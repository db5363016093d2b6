#include "src2d/geometry/outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "src2d/core/error.h"
#include "src2d/geometry/box.h"

namespace merge2d {

int turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  constexpr double kStraight = 1e-10;
  const Vec2 ab = b - a;
  const Vec2 bc = c - b;
  const double product = cross(ab, bc);
  const double straight = kStraight * ab.norm() * bc.norm();
  return product > straight ? 1 : product < -straight ? -1 : 0;
}

bool segmentsMeet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  Aabb ab;
  Aabb cd;
  ab.include(a);
  ab.include(b);
  cd.include(c);
  cd.include(d);
  // For edges on one line the boxes decide.
  return ab.overlaps(cd) && turn(a, b, c) * turn(a, b, d) <= 0 &&
         turn(c, d, a) * turn(c, d, b) <= 0;
}

namespace {

struct OutlineVertex {
  Vec2 point;
  std::size_t index;  // in the outline as it was given, for messages
};
using OutlineVertices = std::vector<OutlineVertex>;

OutlineVertices distinct(const std::vector<Vec2>& outline) {
  Aabb box;
  for (const Vec2& p : outline) {
    if (!p.allFinite())
      throw InputError("the outline has a coordinate that is not a finite number");
    box.include(p);
  }
  const double near = outline.empty() ? 0.0 : 1e-9 * box.extent().maxCoeff();
  OutlineVertices corners;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    // Of several vertices at one place the last stays: the edge that leaves it has its number.
    if ((outline[(i + 1) % outline.size()] - outline[i]).norm() > near) {
      corners.push_back({outline[i], i});
    }
  }
  if (corners.size() < 3) throw InputError("the outline has fewer than three distinct vertices");
  return corners;
}

void rejectCrossings(const OutlineVertices& corners) {
  const std::size_t n = corners.size();
  const auto at = [&](std::size_t i) -> const Vec2& { return corners[i % n].point; };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      bool crosses = false;
      if (j == i + 1 || (i == 0 && j == n - 1)) {  // neighbours, unless the second folds back
        const std::size_t first = j == i + 1 ? i : j;
        const Vec2& middle = at(first + 1);
        crosses = turn(at(first), middle, at(first + 2)) == 0 &&
                  (middle - at(first)).dot(at(first + 2) - middle) < 0.0;
      } else {
        crosses = segmentsMeet(at(i), at(i + 1), at(j), at(j + 1));
      }
      if (crosses) {
        throw InputError(fmt::format("the outline crosses itself between edge {} and edge {}",
                                     corners[i].index, corners[j].index));
      }
    }
  }
}

double twiceArea(const std::vector<Vec2>& points) {
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    sum += cross(points[i] - points[0], points[i + 1] - points[0]);
  }
  return sum;
}

}  // namespace

std::vector<Vec2> withoutStraightVertices(std::vector<Vec2> points) {
  std::size_t before = 0;
  do {  // dropping one vertex may straighten the next
    before = points.size();
    std::vector<Vec2> kept;
    for (std::size_t i = 0; i < before; ++i) {
      const Vec2& previous = kept.empty() ? points.back() : kept.back();
      if (turn(previous, points[i], points[(i + 1) % before]) != 0) kept.push_back(points[i]);
    }
    points = std::move(kept);
  } while (points.size() < before);
  return points;
}

std::vector<Vec2> simpleOutline(const std::vector<Vec2>& outline) {
  const OutlineVertices corners = distinct(outline);
  std::vector<Vec2> points;
  for (const OutlineVertex& corner : corners) points.push_back(corner.point);
  points = withoutStraightVertices(std::move(points));
  if (points.size() < 3) throw InputError("the outline encloses no area");
  rejectCrossings(corners);
  if (twiceArea(points) < 0.0) std::reverse(points.begin(), points.end());
  return points;
}

}  // namespace merge2d
