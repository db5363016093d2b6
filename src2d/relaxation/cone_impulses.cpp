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

/// The impulse along an edge of a point: half of n + t / s.
double heldAlong(double slope, const ConePoint& p) {
  const double along = slope == 0.0 ? 0.0 : p.lambda_t / slope;
  return std::max(0.0, 0.5 * (p.lambda_n + along));
}

}  // namespace

void addEdges(const ConePoint& p, bool seen_by_b, double size, double other_size,
              const ConeEdge& behind, std::vector<ConeEdge>& edges) {
  const double size_a = seen_by_b ? other_size : size, size_b = seen_by_b ? size : other_size;
  for (const double s : {p.mu, -p.mu}) {
    const double x = p.nx - s * p.ny, y = p.ny + s * p.nx;
    const Wrench on_a{-x, -y, -(p.arm_an + s * p.arm_at) / size_a};
    const Wrench on_b{x, y, (p.arm_bn + s * p.arm_bt) / size_b};
    ConeEdge& edge = edges.emplace_back(behind);
    edge.on = seen_by_b ? on_b : on_a;
    edge.on_other = seen_by_b ? on_a : on_b;
    edge.slope = s;
    edge.held = heldAlong(s, p);
  }
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
