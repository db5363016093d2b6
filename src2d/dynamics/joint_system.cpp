#include "src2d/dynamics/joint_system.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace merge2d {
namespace {

/// One row of one joint.
struct RowOf {
  JointBlock* joint;
  std::size_t row;
  const JointRow& get() const { return joint->rows[row]; }
  double& lambda() const { return joint->lambda[row]; }
};

/// A motor that presses against a limit is overruled: the limit holds.
bool isOverruled(const JointBlock& k, std::size_t i) {
  return i == kMotorRow && k.motor && k.limit && k.isWithinBounds(kLimitRow);
}

std::vector<RowOf> rowsOf(Collection& c) {
  std::vector<RowOf> rows;
  for (JointBlock& k : c.joints) {
    k.forEachRow([&](std::size_t i) {
      const bool coupled = static_cast<int>(i) < k.coupled;
      if (coupled || (k.isWithinBounds(i) && !isOverruled(k, i))) rows.push_back({&k, i});
    });
  }
  return rows;
}

/// The residual of each row [m/s, rad/s].
Eigen::VectorXd restOf(const std::vector<RowOf>& rows, const Rotation& turn,
                       const std::vector<SolverVelocity>& u) {
  Eigen::VectorXd rest(static_cast<Eigen::Index>(rows.size()));
  Eigen::Index i = 0;
  for (const RowOf& of : rows) {
    const JointRow& r = of.get();
    rest[i++] =
        jointVelocity(r, turn, u[of.joint->a], u[of.joint->b]) + r.bias + r.softness * of.lambda();
  }
  return rest;
}

/// Where a row acts on a body: against its direction at the joint's first body.
struct RowEnd {
  std::uint32_t body, row;
  double sign, arm;
};

/// By body, then by row; without bodies that do not respond.
std::vector<RowEnd> endsOf(const std::vector<RowOf>& rows, const std::vector<SolverVelocity>& u) {
  std::vector<RowEnd> ends;
  for (std::uint32_t i = 0; i < rows.size(); ++i) {
    const JointRow& r = rows[i].get();
    ends.push_back({rows[i].joint->a, i, -1.0, r.arm_a});
    ends.push_back({rows[i].joint->b, i, 1.0, r.arm_b});
  }
  std::erase_if(ends, [&](const RowEnd& e) { return u[e.body].inv_mass == 0.0; });
  std::ranges::sort(ends, {}, [](const RowEnd& e) { return std::pair(e.body, e.row); });
  return ends;
}

/// J M⁻¹ Jᵀ + C, a little softened: the rows of joints in a ring are linearly dependent.
Eigen::SparseMatrix<double> matrixOf(const std::vector<RowOf>& rows,
                                     const std::vector<SolverVelocity>& u) {
  constexpr double kSlightly = 1e-9;
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](std::uint32_t i, std::uint32_t j, double k) {
    entries.emplace_back(static_cast<int>(i), static_cast<int>(j), k);
  };
  for (std::uint32_t i = 0; i < rows.size(); ++i) add(i, i, rows[i].get().softness);
  const std::vector<RowEnd> ends = endsOf(rows, u);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const JointRow& x = rows[ends[i].row].get();
    for (std::size_t j = i; j < ends.size() && ends[j].body == ends[i].body; ++j) {
      const SolverVelocity& m = u[ends[i].body];
      const JointRow& y = rows[ends[j].row].get();
      const double k =
          ends[i].sign * ends[j].sign *
          (m.inv_mass * (x.dx * y.dx + x.dy * y.dy) + m.inv_inertia * ends[i].arm * ends[j].arm);
      add(ends[j].row, ends[i].row, i == j ? (1.0 + kSlightly) * k : k);
    }
  }
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

void settleJoints(Collection& c, const Rotation& turn, std::vector<SolverVelocity>& u,
                  double enough) {
  if (c.joints.empty()) return;
  const std::vector<RowOf> rows = rowsOf(c);
  const Eigen::VectorXd rest = restOf(rows, turn, u);
  if (rows.empty() || rest.cwiseAbs().maxCoeff() <= enough) return;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrixOf(rows, u));
  if (factor.info() != Eigen::Success) return;  // the sweeps go on alone
  const Eigen::VectorXd change = -factor.solve(rest);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const JointRow& r = rows[i].get();
    double& lambda = rows[i].lambda();
    const double now = std::clamp(lambda + change[static_cast<Eigen::Index>(i)], r.lower, r.upper);
    applyJointImpulse(r, turn, now - lambda, u[rows[i].joint->a], u[rows[i].joint->b]);
    lambda = now;
  }
}

}  // namespace merge2d
