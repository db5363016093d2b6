#pragma once
/// The kernel of every sweep: one joint's rows.
///
/// A row wants w + bias + Cλ = 0, where w = d·(v_b − v_a) + r_b ω_b − r_a ω_a. The first rows,
/// which hold in both directions, are solved together; motor and limit follow one by one, each with
/// bounds on its λ.
///
/// Letters (docs/symbols.md): λ impulse [N s, N m s], w relative velocity [m/s, rad/s],
/// C softness [1/kg, 1/(kg m²)], d direction, r its moment arm [m, 1].

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "src2d/dynamics/contact_block.h"

namespace merge2d {

inline constexpr std::size_t kMotorRow = 2, kLimitRow = 3;

struct JointRow {
  double dx = 0.0, dy = 0.0;        ///< direction in the block's frame; 0 for a turning row
  double arm_a = 0.0, arm_b = 0.0;  ///< (p − x) × d, or 1
  double bias = 0.0, softness = 0.0;
  double inv_k = 0.0;  ///< 1 / (K + C), of motor and limit
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();  ///< of λ, of motor and limit

  bool turns() const { return dx == 0.0 && dy == 0.0; }
};

/// Row 2 is the third of a weld, or else the motor; row 3 is the limit.
struct JointBlock {
  std::uint32_t a = 0, b = 0;  ///< indices into the velocities
  std::uint32_t joint = 0;     ///< of State::joints
  int coupled = 0;             ///< the first rows, solved together
  bool motor = false, limit = false;
  std::array<JointRow, 4> rows;
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();  ///< (K + C)⁻¹ of the coupled rows
  std::array<double, 4> lambda{};

  /// Away from its bounds a row holds in both directions.
  bool isWithinBounds(std::size_t i) const {
    return lambda[i] > rows[i].lower && lambda[i] < rows[i].upper;
  }

  /// The limit leaves no way.
  bool isAtLimit() const {
    const JointRow& row = rows[kLimitRow];
    if (!limit) return false;
    if (row.lower == 0.0) return row.bias <= 0.0;
    return row.upper != 0.0 || row.bias >= 0.0;
  }

  /// The rows that there are, one after the other.
  template <class F>
  void forEachRow(F&& f) const {
    for (std::size_t i = 0; i < static_cast<std::size_t>(coupled); ++i) f(i);
    if (motor) f(kMotorRow);
    if (limit) f(kLimitRow);
  }
};

/// Relative velocity along a row; `turn` brings the block's frame into that of the velocities.
inline double jointVelocity(const JointRow& r, const Rotation& turn, const SolverVelocity& a,
                            const SolverVelocity& b) {
  const double dx = turn.c * r.dx - turn.s * r.dy, dy = turn.s * r.dx + turn.c * r.dy;
  return dx * (b.vx - a.vx) + dy * (b.vy - a.vy) + r.arm_b * b.omega - r.arm_a * a.omega;
}

inline void applyJointImpulse(const JointRow& r, const Rotation& turn, double p, SolverVelocity& a,
                              SolverVelocity& b) {
  const double px = (turn.c * r.dx - turn.s * r.dy) * p, py = (turn.s * r.dx + turn.c * r.dy) * p;
  a.vx -= a.inv_mass * px;
  a.vy -= a.inv_mass * py;
  a.omega -= a.inv_inertia * r.arm_a * p;
  b.vx += b.inv_mass * px;
  b.vy += b.inv_mass * py;
  b.omega += b.inv_inertia * r.arm_b * p;
}

/// J M⁻¹ Jᵀ of two rows.
inline double coupling(const JointRow& r, const JointRow& s, const SolverVelocity& a,
                       const SolverVelocity& b) {
  return (a.inv_mass + b.inv_mass) * (r.dx * s.dx + r.dy * s.dy) +
         a.inv_inertia * r.arm_a * s.arm_a + b.inv_inertia * r.arm_b * s.arm_b;
}

/// Fills `inverse` and `inv_k` of a block whose rows are known.
inline void fillInverse(JointBlock& block, const SolverVelocity& a, const SolverVelocity& b) {
  Eigen::Matrix3d k = Eigen::Matrix3d::Identity();
  for (int i = 0; i < block.coupled; ++i) {
    const JointRow& row = block.rows[static_cast<std::size_t>(i)];
    for (int j = 0; j < block.coupled; ++j) {
      k(i, j) = coupling(row, block.rows[static_cast<std::size_t>(j)], a, b);
    }
    k(i, i) += row.softness;
  }
  block.inverse = k.inverse();
  for (const std::size_t i : {kMotorRow, kLimitRow}) {
    if (!(i == kMotorRow ? block.motor : block.limit)) continue;
    JointRow& row = block.rows[i];
    row.inv_k = 1.0 / (coupling(row, row, a, b) + row.softness);
  }
}

/// All impulses of a block at once: its warm start.
inline void applyJointImpulses(const JointBlock& k, const Rotation& turn, SolverVelocity& a,
                               SolverVelocity& b) {
  k.forEachRow([&](std::size_t i) { applyJointImpulse(k.rows[i], turn, k.lambda[i], a, b); });
}

/// The residual of a row [m/s, rad/s].
inline double jointRest(const JointBlock& k, std::size_t i, const Rotation& turn,
                        const SolverVelocity& a, const SolverVelocity& b) {
  const JointRow& r = k.rows[i];
  return jointVelocity(r, turn, a, b) + r.bias + r.softness * k.lambda[i];
}

/// The change of the relative velocity along each row that a solve would make: the coupled rows
/// together, each of the others alone [m/s, rad/s].
inline std::array<double, 4> changeBySolving(const JointBlock& k, const SolverVelocity& a,
                                             const SolverVelocity& b) {
  Eigen::Vector3d rest = Eigen::Vector3d::Zero(), softness = Eigen::Vector3d::Zero();
  std::array<double, 4> change{};
  k.forEachRow([&](std::size_t i) {
    const JointRow& r = k.rows[i];
    const double error = jointRest(k, i, {}, a, b);
    if (i < static_cast<std::size_t>(k.coupled)) {
      rest[static_cast<Eigen::Index>(i)] = error;
      softness[static_cast<Eigen::Index>(i)] = r.softness;
      return;
    }
    const double x = std::clamp(k.lambda[i] - r.inv_k * error, r.lower, r.upper);
    change[i] = (x - k.lambda[i]) * (1.0 / r.inv_k - r.softness);
  });
  const Eigen::Vector3d together = softness.cwiseProduct(k.inverse * rest) - rest;
  for (std::size_t i = 0; i < static_cast<std::size_t>(k.coupled); ++i) {
    change[i] = together[static_cast<Eigen::Index>(i)];
  }
  return change;
}

/// Solves a motor or a limit.
inline void solveJointBound(JointBlock& k, std::size_t i, const Rotation& turn, SolverVelocity& a,
                            SolverVelocity& b) {
  const JointRow& r = k.rows[i];
  const double x =
      std::clamp(k.lambda[i] - r.inv_k * jointRest(k, i, turn, a, b), r.lower, r.upper);
  applyJointImpulse(r, turn, x - k.lambda[i], a, b);
  k.lambda[i] = x;
}

/// Solves the rows that hold in both directions.
inline void solveJointTogether(JointBlock& k, const Rotation& turn, SolverVelocity& a,
                               SolverVelocity& b) {
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  const auto coupled = static_cast<std::size_t>(k.coupled);
  for (std::size_t i = 0; i < coupled; ++i) {
    w[static_cast<Eigen::Index>(i)] = jointRest(k, i, turn, a, b);
  }
  const Eigen::Vector3d change = -(k.inverse * w);
  for (std::size_t i = 0; i < coupled; ++i) {
    const double p = change[static_cast<Eigen::Index>(i)];
    applyJointImpulse(k.rows[i], turn, p, a, b);
    k.lambda[i] += p;
  }
}

/// Solves one block: motor and limit first, so that the rows that hold the bodies together have the
/// last word.
inline void solveJoint(JointBlock& k, const Rotation& turn, SolverVelocity& a, SolverVelocity& b) {
  if (k.motor) solveJointBound(k, kMotorRow, turn, a, b);
  if (k.limit) solveJointBound(k, kLimitRow, turn, a, b);
  solveJointTogether(k, turn, a, b);
}

}  // namespace merge2d
