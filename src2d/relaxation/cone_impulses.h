#pragma once
/// Impulses of contact points in the plane as sums over the two edges of each point's friction
/// cone: admissible (Eqs. 4 to 7) where no edge is negative.

#include <cstdint>
#include <span>
#include <vector>

namespace merge2d {

/// An impulse on a body, and its moment about the centre of mass divided by the body's size
/// [N s].
struct Wrench {
  double x = 0.0, y = 0.0, spin = 0.0;

  Wrench& operator+=(const Wrench& w) {
    x += w.x;
    y += w.y;
    spin += w.spin;
    return *this;
  }
  friend Wrench operator*(double s, const Wrench& w) { return {s * w.x, s * w.y, s * w.spin}; }
  double dot(const Wrench& w) const { return x * w.x + y * w.y + spin * w.spin; }
};

/// One edge n + s t of the cone of a point, where |s| is the friction.
struct ConeEdge {
  Wrench on{}, on_other{};  ///< of a unit of it: on the body in question, and on the one behind it
  double slope = 0.0;       ///< s
  double held = 0.0;        ///< impulse along it that there is [N s]
  double change = 0.0;      ///< of that [N s]
  std::uint32_t other = 0;  ///< the body behind the contact
  std::uint32_t block = 0;  ///< of the contact
  int point = 0;
};

/// A point between the bodies a and b; the normal points from a to b.
struct ConePoint {
  double nx = 0.0, ny = 0.0;
  double arm_an = 0.0, arm_at = 0.0;      ///< moments of the normal and of the tangent about a [m]
  double arm_bn = 0.0, arm_bt = 0.0;      ///< about b [m]
  double mu = 0.0;                        ///< friction
  double lambda_n = 0.0, lambda_t = 0.0;  ///< its impulses [N s]
};

/// Adds both edges of its cone, as seen by b or by a. Moments are divided by the sizes of that body
/// and of the other [m]; `behind` has the body, the block and the point of the contact.
void addEdges(const ConePoint& point, bool seen_by_b, double size, double other_size,
              const ConeEdge& behind, std::vector<ConeEdge>& edges);

/// Finds the smallest change of the impulses along the edges of a body that balances a load on it
/// and makes none of them negative. Returns the rest of the load.
Wrench balance(std::span<ConeEdge> edges, const Wrench& load);

}  // namespace merge2d
