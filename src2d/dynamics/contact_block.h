#pragma once
/// The kernel of every sweep: one manifold's contact rows, solved as a block.
///
/// Source: projected Gauss-Seidel on Eqs. (4)-(7) and (9), with the two normals of a manifold
/// solved together. A block holds the impulses of its points; a sweep changes them and the
/// velocities of the two bodies, so that u = u₀ + M⁻¹Jᵀλ holds at any time.
///
/// Letters (docs/symbols.md): λ impulse [N s], w relative velocity at the contact [m/s],
/// K = J M⁻¹ Jᵀ [1/kg], C softness [1/kg], n normal from a to b, t = n turned by +90°.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "src2d/core/pose.h"

namespace merge2d {

/// The data of a body that a sweep needs: one cache line.
struct alignas(64) SolverVelocity {
  double vx = 0.0, vy = 0.0;  ///< of the centre of mass [m/s]
  double omega = 0.0;         ///< [rad/s]
  double inv_mass = 0.0;      ///< 0: does not respond to forces [1/kg]
  double inv_inertia = 0.0;   ///< [1/(kg m²)]
  double surface = 0.0;       ///< speed of its belt [m/s]
  /// The change of the last step's velocity by the loads and the full solve [m/s, rad/s].
  std::array<float, 3> gained{};

  /// A body that does not is never written to: many islands stand on it, each perhaps in another
  /// thread.
  bool responds() const { return inv_mass != 0.0; }
};

/// The rows of one manifold. Lever arms are moments of the unit normal or tangent about the centre
/// of mass; they do not change when the whole pair is turned, so a block stays valid in the frame
/// of a rigid collection and only its normal is turned.
struct ContactBlock {
  std::uint32_t a = 0, b = 0;  ///< indices into the velocities
  std::int32_t count = 0;      ///< points, 1 or 2
  bool bilateral = false;      ///< a magnet's contact: pulls, and does not slide
  std::uint8_t hits = 0;  ///< bit i: point i is left to dynamics/hits.h; bit 2 + i: as it was cast
  double nx = 1.0, ny = 0.0;                      ///< normal
  double arm_an[2] = {0, 0}, arm_bn[2] = {0, 0};  ///< r × n [m]
  double arm_at[2] = {0, 0}, arm_bt[2] = {0, 0};  ///< r × t [m]
  double k11 = 1.0, k12 = 0.0, k22 = 1.0;         ///< K + C of the normals
  double inv_det = 1.0;                           ///< of that matrix
  double inv_kt[2] = {0, 0};                      ///< 1 / K of each tangent
  double softness = 0.0;                          ///< C
  double bias[2] = {0, 0};                        ///< wanted: w_n + bias + Cλ ≥ 0 [m/s]
  double mu = 0.0;
  std::array<double, 4> lambda{};  ///< both normals, then both tangents [N s]

  double& lambda_n(int i) { return lambda[static_cast<std::size_t>(i)]; }
  double& lambda_t(int i) { return lambda[static_cast<std::size_t>(i) + 2]; }
  double lambda_n(int i) const { return lambda[static_cast<std::size_t>(i)]; }
  double lambda_t(int i) const { return lambda[static_cast<std::size_t>(i) + 2]; }

  /// Rolling resistance, of a single point alone, stands in the places of a second one: its lever
  /// arm [m] in that of the bias, its impulse [N m s] in that of the tangent.
  bool rolls() const { return count == 1 && bias[1] > 0.0; }
  double rolling() const { return bias[1]; }
  double lambda_r() const { return rolls() ? lambda[3] : 0.0; }
  void setRolling(double arm, double impulse) {
    const double limit = arm * std::max(0.0, lambda[0]);
    bias[1] = arm;
    lambda[3] = std::clamp(impulse, -limit, limit);
  }
};

/// Relative velocity of b against a at point `i` along the normal and the tangent, and there of
/// their belts: each runs clockwise round its body, and the two face each other.
struct ContactVelocity {
  double n = 0.0, t = 0.0;
};
inline ContactVelocity contactVelocity(const ContactBlock& k, int i, double nx, double ny,
                                       const SolverVelocity& a, const SolverVelocity& b) {
  const double dx = b.vx - a.vx, dy = b.vy - a.vy;
  return {
      nx * dx + ny * dy + k.arm_bn[i] * b.omega - k.arm_an[i] * a.omega,
      nx * dy - ny * dx + k.arm_bt[i] * b.omega - k.arm_at[i] * a.omega + a.surface + b.surface};
}

/// Adds the impulses `pn` along the normal and `pt` along the tangent at point `i`.
inline void applyImpulse(const ContactBlock& k, int i, double nx, double ny, double pn, double pt,
                         SolverVelocity& a, SolverVelocity& b) {
  const double px = nx * pn - ny * pt, py = ny * pn + nx * pt;
  if (a.responds()) {
    a.vx -= a.inv_mass * px;
    a.vy -= a.inv_mass * py;
    a.omega -= a.inv_inertia * (k.arm_an[i] * pn + k.arm_at[i] * pt);
  }
  if (b.responds()) {
    b.vx += b.inv_mass * px;
    b.vy += b.inv_mass * py;
    b.omega += b.inv_inertia * (k.arm_bn[i] * pn + k.arm_bt[i] * pt);
  }
}

/// Adds the moment `p` against rolling [N m s].
inline void applyRolling(double p, SolverVelocity& a, SolverVelocity& b) {
  if (a.responds()) a.omega -= a.inv_inertia * p;
  if (b.responds()) b.omega += b.inv_inertia * p;
}

/// A block of a collection with this rotation, in the world.
inline ContactBlock turned(const Rotation& rotation, ContactBlock k) {
  const Vec2 n = rotation * Vec2(k.nx, k.ny);
  k.nx = n.x();
  k.ny = n.y();
  return k;
}

/// All impulses of a block at once: its warm start.
inline void applyImpulses(const ContactBlock& k, SolverVelocity& a, SolverVelocity& b) {
  for (int i = 0; i < k.count; ++i) {
    applyImpulse(k, i, k.nx, k.ny, k.lambda_n(i), k.lambda_t(i), a, b);
  }
  if (k.rolls()) applyRolling(k.lambda[3], a, b);
}

/// The exact solution x ≥ 0, (K+C)x + q ≥ 0, x·((K+C)x + q) = 0 of the two normals, by cases.
inline void solveNormalPair(const ContactBlock& k, double w1, double w2, double& x1, double& x2) {
  const double l1 = k.lambda_n(0), l2 = k.lambda_n(1);
  x1 = l1 - (k.k22 * w1 - k.k12 * w2) * k.inv_det;
  x2 = l2 - (k.k11 * w2 - k.k12 * w1) * k.inv_det;
  if ((x1 >= 0.0 && x2 >= 0.0) || k.bilateral) return;  // both press

  const double q1 = w1 - k.k11 * l1 - k.k12 * l2;
  const double q2 = w2 - k.k12 * l1 - k.k22 * l2;
  const double only1 = -q1 / k.k11, leaves2 = k.k12 * only1 + q2;
  x1 = only1;
  x2 = 0.0;
  if (only1 >= 0.0 && leaves2 >= 0.0) return;  // only the first presses
  const double only2 = -q2 / k.k22, leaves1 = k.k12 * only2 + q1;
  x1 = 0.0;
  x2 = only2;
  if (only2 >= 0.0 && leaves1 >= 0.0) return;  // only the second presses
  x2 = 0.0;
  if (q1 >= 0.0 && q2 >= 0.0) return;  // none presses

  // One of them does, and is missed by a rounding error.
  if (std::min(-q1, leaves2) >= std::min(-q2, leaves1)) {
    x1 = std::max(0.0, only1);
  } else {
    x2 = std::max(0.0, only2);
  }
}

/// The impulse at the limits of friction, where the tangent moves by `w` [m/s].
inline double solveTangent(const ContactBlock& k, int i, double w) {
  const double limit = k.bilateral ? std::numeric_limits<double>::infinity() : k.mu * k.lambda_n(i);
  return std::clamp(k.lambda_t(i) - k.inv_kt[i] * w, -limit, limit);
}

/// The change of the moment against rolling, where the bodies turn by `w` against each other
/// [rad/s]: like friction, but of a torque, and bounded by a lever arm.
inline double solveRolling(ContactBlock& k, double w, const SolverVelocity& a,
                           const SolverVelocity& b) {
  const double limit = k.rolling() * std::max(0.0, k.lambda_n(0));
  const double before = k.lambda[3];
  k.lambda[3] = std::clamp(before - w / (a.inv_inertia + b.inv_inertia), -limit, limit);
  return k.lambda[3] - before;
}

/// The friction of two points as one row, where their pressure has its centre: on a flat face the
/// two rows are the same, and sweeps push impulses from one to the other. Where the points are
/// close to each other such sweeps may not converge. Each point has its part of the pressure.
struct ManifoldFriction {
  double part[2] = {0.5, 0.5};
  double arm_a = 0.0, arm_b = 0.0;  ///< r × t [m]
  double inv_k = 0.0;               ///< 1 / K, between those of the points
  double limit = std::numeric_limits<double>::infinity();

  explicit ManifoldFriction(const ContactBlock& k) {
    const double pressure = k.lambda_n(0) + k.lambda_n(1);
    if (!k.bilateral) limit = k.mu * pressure;
    if (!k.bilateral && pressure > 0.0) {
      part[0] = k.lambda_n(0) / pressure;
      part[1] = 1.0 - part[0];
    }
    arm_a = part[0] * k.arm_at[0] + part[1] * k.arm_at[1];
    arm_b = part[0] * k.arm_bt[0] + part[1] * k.arm_bt[1];
    inv_k = part[0] * k.inv_kt[0] + part[1] * k.inv_kt[1];
  }

  /// The impulse of both, where the tangent moves by `w` [m/s].
  double solve(const ContactBlock& k, double w) const {
    return std::clamp(k.lambda_t(0) + k.lambda_t(1) - inv_k * w, -limit, limit);
  }
};

/// How two bodies turn while a block is solved [rad/s], and the impulses that it adds meanwhile
/// along its normal and its tangent [N s].
struct BlockSolve {
  double omega_a, omega_b;
  double p_n = 0.0, p_t = 0.0;
};

/// The rows of two points, where their centres of mass move by `v_n` and `v_t`.
inline void solveTwoPoints(ContactBlock& k, double v_n, double v_t, const SolverVelocity& a,
                           const SolverVelocity& b, BlockSolve& s) {
  const double w1 = v_n + k.arm_bn[0] * s.omega_b - k.arm_an[0] * s.omega_a + k.bias[0] +
                    k.softness * k.lambda_n(0);
  const double w2 = v_n + k.arm_bn[1] * s.omega_b - k.arm_an[1] * s.omega_a + k.bias[1] +
                    k.softness * k.lambda_n(1);
  double x1, x2;
  solveNormalPair(k, w1, w2, x1, x2);
  const double p1 = x1 - k.lambda_n(0), p2 = x2 - k.lambda_n(1);
  k.lambda_n(0) = x1;
  k.lambda_n(1) = x2;
  s.p_n = p1 + p2;
  s.omega_a -= a.inv_inertia * (k.arm_an[0] * p1 + k.arm_an[1] * p2);
  s.omega_b += b.inv_inertia * (k.arm_bn[0] * p1 + k.arm_bn[1] * p2);

  const ManifoldFriction f(k);
  const double y = f.solve(k, v_t + f.arm_b * s.omega_b - f.arm_a * s.omega_a);
  const double y1 = f.part[0] * y, y2 = f.part[1] * y;
  const double q1 = y1 - k.lambda_t(0), q2 = y2 - k.lambda_t(1);
  k.lambda_t(0) = y1;
  k.lambda_t(1) = y2;
  s.p_t = q1 + q2;
  s.omega_a -= a.inv_inertia * (k.arm_at[0] * q1 + k.arm_at[1] * q2);
  s.omega_b += b.inv_inertia * (k.arm_bt[0] * q1 + k.arm_bt[1] * q2);
}

/// The rows of one point, likewise.
inline void solveOnePoint(ContactBlock& k, double v_n, double v_t, const SolverVelocity& a,
                          const SolverVelocity& b, BlockSolve& s) {
  const double w = v_n + k.arm_bn[0] * s.omega_b - k.arm_an[0] * s.omega_a + k.bias[0] +
                   k.softness * k.lambda_n(0);
  double x = k.lambda_n(0) - w / k.k11;
  if (!k.bilateral) x = std::max(0.0, x);
  s.p_n = x - k.lambda_n(0);
  k.lambda_n(0) = x;
  s.omega_a -= a.inv_inertia * k.arm_an[0] * s.p_n;
  s.omega_b += b.inv_inertia * k.arm_bn[0] * s.p_n;

  const double y = solveTangent(k, 0, v_t + k.arm_bt[0] * s.omega_b - k.arm_at[0] * s.omega_a);
  s.p_t = y - k.lambda_t(0);
  k.lambda_t(0) = y;
  s.omega_a -= a.inv_inertia * k.arm_at[0] * s.p_t;
  s.omega_b += b.inv_inertia * k.arm_bt[0] * s.p_t;
  if (!k.rolls()) return;
  const double p_r = solveRolling(k, s.omega_b - s.omega_a, a, b);
  s.omega_a -= a.inv_inertia * p_r;
  s.omega_b += b.inv_inertia * p_r;
}

/// Solves one block: normals together, then their friction (Eqs. (5)-(7)). `nx`, `ny` is
/// the block's normal in the frame of the velocities. The rows share a normal: what one of them
/// changes for the next is told by its impulse alone, so that the velocities are read and written
/// once.
inline void solveBlock(ContactBlock& k, double nx, double ny, SolverVelocity& a,
                       SolverVelocity& b) {
  const double dx = b.vx - a.vx, dy = b.vy - a.vy;
  const double v_n = nx * dx + ny * dy;  // of the centres of mass
  const double v_t = nx * dy - ny * dx + a.surface + b.surface;
  BlockSolve s{a.omega, b.omega};
  if (k.count == 2) {
    solveTwoPoints(k, v_n, v_t, a, b, s);
  } else {
    solveOnePoint(k, v_n, v_t, a, b, s);
  }
  const double px = nx * s.p_n - ny * s.p_t, py = ny * s.p_n + nx * s.p_t;
  if (a.responds()) {
    a.vx -= a.inv_mass * px;
    a.vy -= a.inv_mass * py;
    a.omega = s.omega_a;
  }
  if (b.responds()) {
    b.vx += b.inv_mass * px;
    b.vy += b.inv_mass * py;
    b.omega = s.omega_b;
  }
}

/// The paper's plain PGS: one row at a time, each normal followed by its friction.
inline void solveRows(ContactBlock& k, double nx, double ny, SolverVelocity& a, SolverVelocity& b) {
  for (int i = 0; i < k.count; ++i) {
    const double w_n =
        contactVelocity(k, i, nx, ny, a, b).n + k.bias[i] + k.softness * k.lambda_n(i);
    double x = k.lambda_n(i) - w_n / (i == 0 ? k.k11 : k.k22);
    if (!k.bilateral) x = std::max(0.0, x);
    applyImpulse(k, i, nx, ny, x - k.lambda_n(i), 0.0, a, b);
    k.lambda_n(i) = x;
    const double w_t = contactVelocity(k, i, nx, ny, a, b).t;
    const double limit =
        k.bilateral ? std::numeric_limits<double>::infinity() : k.mu * k.lambda_n(i);
    const double y = std::clamp(k.lambda_t(i) - k.inv_kt[i] * w_t, -limit, limit);
    applyImpulse(k, i, nx, ny, 0.0, y - k.lambda_t(i), a, b);
    k.lambda_t(i) = y;
  }
  if (k.rolls()) applyRolling(solveRolling(k, b.omega - a.omega, a, b), a, b);
}

/// The change that one more solve of its rows would make, as a velocity [m/s].
inline double residualOf(const ContactBlock& k, double nx, double ny, const SolverVelocity& a,
                         const SolverVelocity& b) {
  double most = 0.0;
  for (int i = 0; i < k.count; ++i) {
    const ContactVelocity w = contactVelocity(k, i, nx, ny, a, b);
    const double kn = i == 0 ? k.k11 : k.k22;
    double x = k.lambda_n(i) - (w.n + k.bias[i] + k.softness * k.lambda_n(i)) / kn;
    if (!k.bilateral) x = std::max(0.0, x);
    const double y = solveTangent(k, i, w.t);
    most = std::max(
        {most, std::abs(x - k.lambda_n(i)) * kn, std::abs(y - k.lambda_t(i)) / k.inv_kt[i]});
  }
  return most;
}

/// Where a manifold acts: what a block is made from.
struct BlockGeometry {
  Vec2 normal = Vec2::UnitX();
  int count = 0;
  Vec2 arm_a[2] = {Vec2::Zero(), Vec2::Zero()};  ///< from a's centre of mass to the point [m]
  Vec2 arm_b[2] = {Vec2::Zero(), Vec2::Zero()};
  double softness = 0.0;
};

/// Fills the normal and the lever arms of `k`.
inline void setArms(ContactBlock& k, const BlockGeometry& g) {
  const Vec2 t = perpendicular(g.normal);
  k.nx = g.normal.x();
  k.ny = g.normal.y();
  k.count = g.count;
  for (int i = 0; i < g.count; ++i) {
    k.arm_an[i] = cross(g.arm_a[i], g.normal);
    k.arm_bn[i] = cross(g.arm_b[i], g.normal);
    k.arm_at[i] = cross(g.arm_a[i], t);
    k.arm_bt[i] = cross(g.arm_b[i], t);
  }
}

/// Fills the effective masses of `k`, whose arms are known. Two points that are too close for their
/// 2×2 matrix to be inverted well are treated as one, the first.
inline void fillMasses(ContactBlock& k, double softness, const SolverVelocity& a,
                       const SolverVelocity& b) {
  k.softness = softness;
  const double inv_mass = a.inv_mass + b.inv_mass;
  for (int i = 0; i < k.count; ++i) {
    k.inv_kt[i] = 1.0 / (inv_mass + a.inv_inertia * k.arm_at[i] * k.arm_at[i] +
                         b.inv_inertia * k.arm_bt[i] * k.arm_bt[i]);
  }
  const auto normalK = [&](int i, int j) {
    return inv_mass + a.inv_inertia * k.arm_an[i] * k.arm_an[j] +
           b.inv_inertia * k.arm_bn[i] * k.arm_bn[j];
  };
  k.k11 = normalK(0, 0) + softness;
  if (k.count < 2) return;
  k.k22 = normalK(1, 1) + softness;
  k.k12 = normalK(0, 1);
  const double det = k.k11 * k.k22 - k.k12 * k.k12;
  if (det < 1e-6 * k.k11 * k.k22) {
    k.count = 1;
    k.lambda_n(1) = k.lambda_t(1) = k.bias[1] = k.k12 = k.k22 = k.inv_kt[1] = 0.0;
    k.arm_an[1] = k.arm_bn[1] = k.arm_at[1] = k.arm_bt[1] = 0.0;
  } else {
    k.inv_det = 1.0 / det;
  }
}

/// Fills geometry and effective masses of `k`.
inline void prepareBlock(ContactBlock& k, const BlockGeometry& g, const SolverVelocity& a,
                         const SolverVelocity& b) {
  setArms(k, g);
  fillMasses(k, g.softness, a, b);
}

}  // namespace merge2d
