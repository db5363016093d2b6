#pragma once
/// The unknowns of a direct solve (dynamics/newton.h): impulses between their bounds.

#include <array>
#include <cstdint>
#include <limits>

namespace merge2d {

inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// One side on which an impulse may be bounded: how far it is from there [N s], and the velocity
/// that the bound leaves [m/s]; and how a step changes these.
struct Bound {
  bool exists = false;
  double gap = 1.0, slack = 0.0;
  double d_gap = 0.0, d_slack = 0.0;

  double stiffness() const { return slack / gap; }
  double product(double s = 0.0) const { return (gap + s * d_gap) * (slack + s * d_slack); }
  /// The change of the product that a step is to make beyond its linear part.
  double wanted(double target, bool corrects) const {
    return target - gap * slack - (corrects ? d_gap * d_slack : 0.0);
  }
};

/// An impulse that is sought, between its bounds.
struct BoundedImpulse {
  double x = 0.0;      ///< [N s]
  double error = 0.0;  ///< by which the velocity along it misses [m/s]
  double rhs = 0.0;    ///< of its equation in a step [m/s]
  Bound low, high;

  double stiffness() const {
    return (low.exists ? low.stiffness() : 0.0) + (high.exists ? high.stiffness() : 0.0);
  }
  template <class Visit>
  void forEachBound(Visit&& visit) {
    if (low.exists) visit(low);
    if (high.exists) visit(high);
  }
  template <class Visit>
  void forEachBound(Visit&& visit) const {
    if (low.exists) visit(low);
    if (high.exists) visit(high);
  }
};

/// A row with its impulse, or the normal and the tangent of a point with those along the edges of
/// its cone; between a lower and an upper bound.
struct RowGroup {
  std::uint32_t row = 0, unknown = 0;
  double mu = -1.0;  ///< of the cone, if it is one
  double softness = 0.0;
  double lower = 0.0, upper = kUnbounded;
  std::array<double, 3> inverse{};  ///< of the matrix of its impulses: 11, 12, 22

  bool isCone() const { return mu >= 0.0; }
  bool isFree() const { return isCone() || upper > lower; }
  std::uint32_t size() const { return isCone() ? 2 : 1; }
};

}  // namespace merge2d
