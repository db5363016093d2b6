/// Convex decomposition of a simple polygon. A diagonal from each reflex vertex takes its reflex
/// angle apart (Chazelle and Dobkin 1985: r reflex vertices leave at most 2r + 1 pieces). Diagonals
/// that do so for both their ends come first, then short ones. Convex pieces with too many vertices
/// are halved.

#include <algorithm>
#include <optional>

#include "src2d/core/error.h"
#include "src2d/geometry/outline.h"
#include "src2d/geometry/shape.h"

namespace merge2d {

namespace {

using Loop = std::vector<Vec2>;  // counter-clockwise

/// A vertex with those before and after it.
struct Corner {
  Vec2 before, at, after;

  bool reflex() const { return turn(before, at, after) < 0; }
  /// Whether the way to `p` starts strictly inside (O'Rourke 1998, InCone).
  bool sees(const Vec2& p) const {
    if (reflex()) return turn(at, p, after) < 0 || turn(p, at, before) < 0;
    return turn(at, p, before) > 0 && turn(p, at, after) > 0;
  }
  /// Whether a diagonal to `p` leaves no reflex angle on either side.
  bool solvedBy(const Vec2& p) const { return turn(before, at, p) >= 0 && turn(p, at, after) >= 0; }
};

Corner cornerAt(const Loop& loop, std::size_t i) {
  const std::size_t n = loop.size();
  return {loop[(i + n - 1) % n], loop[i], loop[(i + 1) % n]};
}

/// Whether the segment between vertices i and j touches no edge but those at its ends.
bool unblocked(const Loop& loop, std::size_t i, std::size_t j) {
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const std::size_t next = (k + 1) % loop.size();
    if (k == i || k == j || next == i || next == j) continue;
    if (segmentsMeet(loop[i], loop[j], loop[k], loop[next])) return false;
  }
  return true;
}

/// Where a diagonal from the reflex vertex i should end.
std::size_t diagonalFrom(const Loop& loop, std::size_t i) {
  struct Candidate {
    std::size_t end;
    int solved;
    double length;
  };
  const Corner from = cornerAt(loop, i);
  std::vector<Candidate> candidates;
  for (std::size_t j = 0; j < loop.size(); ++j) {
    const Corner to = cornerAt(loop, j);
    if (j == i || !from.sees(to.at) || !to.sees(from.at)) continue;
    const int solved = !from.solvedBy(to.at) ? 0 : (to.reflex() && to.solvedBy(from.at) ? 2 : 1);
    candidates.push_back({j, solved, (to.at - from.at).norm()});
  }
  const auto better = [](const Candidate& a, const Candidate& b) {
    return a.solved != b.solved ? a.solved > b.solved : a.length < b.length;
  };
  std::stable_sort(candidates.begin(), candidates.end(), better);
  for (const Candidate& c : candidates) {
    if (unblocked(loop, i, c.end)) return c.end;
  }
  throw InputError("the outline is too thin to be cut into convex pieces");
}

std::optional<std::size_t> firstReflex(const Loop& loop) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (cornerAt(loop, i).reflex()) return i;
  }
  return {};
}

/// Halves a convex polygon until its parts have few enough vertices.
void halve(const Polygon& polygon, std::vector<Polygon>& pieces) {
  const std::vector<Vec2>& v = polygon.vertices;
  if (v.size() <= Polygon::kMaxVertices) {
    pieces.push_back(polygon);
    return;
  }
  const auto middle = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
  Polygon second = {{middle, v.end()}};
  second.vertices.push_back(v.front());
  halve({{v.begin(), middle + 1}}, pieces);
  halve(second, pieces);
}

}  // namespace

std::vector<Polygon> convexPieces(const std::vector<Vec2>& outline) {
  std::vector<Polygon> pieces;
  std::vector<Loop> open = {simpleOutline(outline)};
  while (!open.empty()) {
    Loop loop = std::move(open.back());
    open.pop_back();
    const std::optional<std::size_t> reflex = firstReflex(loop);
    if (!reflex) {
      halve({withoutStraightVertices(std::move(loop))}, pieces);
      continue;
    }
    // Both parts keep the two ends of the diagonal.
    const auto [low, high] = std::minmax({*reflex, diagonalFrom(loop, *reflex)});
    const auto first = loop.begin() + static_cast<std::ptrdiff_t>(low);
    const auto last = loop.begin() + static_cast<std::ptrdiff_t>(high);
    Loop inner(first, last + 1);
    loop.erase(first + 1, last);
    open.push_back(std::move(inner));
    open.push_back(std::move(loop));
  }
  return pieces;
}

}  // namespace merge2d
