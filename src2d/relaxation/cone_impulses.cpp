#include "src2d/relaxation/cone_impulses.h"

#include <algorithm>
#include <array>

#include "src2d/core/small_cholesky.h"

namespace merge2d {
namespace {

/// Σ e eᵀ over the edges whose change follows the multipliers y.
std::array<std::array<double, 3>, 3> curvature(std::span<const ConeEdge> edges, const Wrench& y) {
  Wrench x, s;  // the columns of x and of the spin; yy stands alone
  double yy = 0.0;
  for (const ConeEdge& edge : edges) {
    const Wrench& e = edge.on;
    if (e.dot(y) < -edge.held) continue;
    x += e.x * e;
    s += e.spin * e;
    yy += e.y * e.y;
  }
  return {{{x.x, x.y, x.spin}, {x.y, yy, s.y}, {x.spin, s.y, s.spin}}};
}

/// Sets the changes that follow from the multipliers; returns the rest of the load.
Wrench follow(std::span<ConeEdge> edges, const Wrench& y, Wrench left) {
  for (ConeEdge& edge : edges) {
    edge.change = std::max(-edge.held, edge.on.dot(y));
    left += edge.change * edge.on;
  }
  return left;
}

}  // namespace

double heldAlong(double slope, double lambda_n, double lambda_t) {
  const double along = slope == 0.0 ? 0.0 : lambda_t / slope;
  return std::max(0.0, 0.5 * (lambda_n + along));
}

/// Newton's method on the three multipliers of a projection. The change of an edge is its product
/// with them, bounded from below, so the equations are linear in pieces.
Wrench balance(std::span<ConeEdge> edges, const Wrench& load) {
  constexpr int kSteps = 20;
  constexpr double kExact = 1e-9;  // of the load
  Wrench left = load, y;
  for (int i = 0; i < kSteps && left.dot(left) > kExact * kExact * load.dot(load); ++i) {
    const auto step = solveSymmetric<3>(curvature(edges, y), {left.x, left.y, left.spin}, 3);
    y += {-step[0], -step[1], -step[2]};
    left = follow(edges, y, load);
  }
  return left;
}

}  // namespace merge2d
