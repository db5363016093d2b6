#pragma once
/// The impulses of one contact point at a hit, normal and friction together.
///
/// A sweep finds the normal impulse for the friction that it knows, and then the friction. At a
/// hit that leaves a body free to turn, the two may not settle: with high friction each undoes
/// the other (μ |K_nt| > K_nn), and the point bears nothing at all. So a point that is hit alone
/// is solved by cases: parting, sticking, sliding either way. Letters: contact_block.h.

#include <algorithm>
#include <cmath>

#include "src2d/dynamics/contact_block.h"

namespace merge2d {

/// K = J M⁻¹ Jᵀ of the normal and the tangent of point `i` [1/kg].
struct PointMatrix {
  double nn, nt, tt;
};
inline PointMatrix pointMatrix(const ContactBlock& k, int i, const SolverVelocity& a,
                               const SolverVelocity& b) {
  return {i == 0 ? k.k11 : k.k22,
          a.inv_inertia * k.arm_an[i] * k.arm_at[i] + b.inv_inertia * k.arm_bn[i] * k.arm_bt[i],
          1.0 / k.inv_kt[i]};
}

/// The impulses x with x_n ≥ 0, |x_t| ≤ μ x_n after which nothing approaches, sliding only against
/// the full friction; `q` is the velocity without them [m/s].
inline Vec2 impactOf(const PointMatrix& m, double mu, const Vec2& q) {
  if (q.x() >= 0.0) return Vec2::Zero();
  const double det = m.nn * m.tt - m.nt * m.nt;
  const Vec2 sticks(-(m.tt * q.x() - m.nt * q.y()) / det, -(m.nn * q.y() - m.nt * q.x()) / det);
  if (sticks.x() >= 0.0 && std::abs(sticks.y()) <= mu * sticks.x()) return sticks;
  for (const double way : {1.0, -1.0}) {
    const double k = m.nn - way * mu * m.nt;  // where it slides that way
    const double x = -q.x() / k;
    if (k > 0.0 && way * (q.y() + (m.nt - way * mu * m.tt) * x) >= 0.0) return {x, -way * mu * x};
  }
  // Missed by a rounding error: sticking at the edge of the cone.
  const double x = -q.x() / m.nn;
  return {x, std::clamp(-q.y() / m.tt, -mu * x, mu * x)};
}

/// Solves point `i` of a block, of which no other one acts.
inline void solvePoint(ContactBlock& k, int i, SolverVelocity& a, SolverVelocity& b) {
  const PointMatrix m = pointMatrix(k, i, a, b);
  const ContactVelocity w = contactVelocity(k, i, k.nx, k.ny, a, b);
  const Vec2 before(k.lambda_n(i), k.lambda_t(i));
  const Vec2 q(w.n + k.bias[i] - m.nn * before.x() - m.nt * before.y(),
               w.t - m.nt * before.x() - m.tt * before.y());
  const Vec2 x = impactOf(m, k.mu, q);
  k.lambda_n(i) = x.x();
  k.lambda_t(i) = x.y();
  applyImpulse(k, i, k.nx, k.ny, x.x() - before.x(), x.y() - before.y(), a, b);
  if (k.rolls()) applyRolling(solveRolling(k, b.omega - a.omega, a, b), a, b);
}

}  // namespace merge2d
