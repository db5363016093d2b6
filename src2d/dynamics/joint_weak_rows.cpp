/// Rows of joints that say little or nothing beyond the others: joint_solver.h.

#include <algorithm>

#include "src2d/dynamics/joint_matrix.h"
#include "src2d/dynamics/joint_solver.h"

namespace merge2d {
namespace {

double dot(const std::vector<JointVector>& a, const std::vector<JointVector>& b) {
  double sum = 0.0;
  for (std::size_t c = 0; c < a.size(); ++c) {
    for (std::size_t i = 0; i < 3; ++i) sum += a[c][i] * b[c][i];
  }
  return sum;
}

}  // namespace

void JointSolver::factoriseWeakRows() {
  const std::size_t n = m_.weak.size();
  for (WeakRow& weak : m_.weak) {
    weak.coupled.assign(m_.columns.size(), {});
    for (std::size_t c = 0; c < m_.columns.size(); ++c) {
      const JointMatrix k = coupling(m_.columns[c], m_.columns[weak.column]);
      for (std::size_t i = 0; i < 3; ++i) weak.coupled[c][i] = k[i][weak.row];
    }
    weak.coupled[weak.column][weak.row] = weak.own;
    weak.solved = weak.coupled;
    substitute(weak.solved);
  }
  m_.schur.resize(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const WeakRow &x = m_.weak[i], &y = m_.weak[j];
      m_.schur[i * n + j] = x.coupled[y.column][y.row] - dot(x.coupled, y.solved);
    }
  }
  invertSchur();
}

void JointSolver::invertSchur() {
  const std::size_t n = m_.weak.size();
  const auto at = [&](std::size_t i, std::size_t j) -> double& { return m_.schur[i * n + j]; };
  std::vector<bool> done(n, false);
  const auto left = [&](std::size_t i) { return at(i, i) / m_.weak[i].own; };
  for (std::size_t count = 0; count < n; ++count) {
    const std::size_t i = strongestRow(n, left, [&](std::size_t r) { return done[r]; });
    const WeakRow& weak = m_.weak[i];
    done[i] = true;
    if (left(i) <= kDependent) {
      soften(weak.column, weak.row, at(i, i) = kSoftened * weak.own);
    }
    exchangeRow(at, n, i);
  }
}

/// x_A = A⁻¹ (r_A − B x_D), where x_D = S⁻¹ (r_D − Bᵀ A⁻¹ r_A).
void JointSolver::addWeakRows(std::vector<JointVector>& x) {
  const std::size_t n = m_.weak.size();
  std::vector<double>& rest = m_.weak_change;
  rest.resize(n);
  for (std::size_t i = 0; i < n; ++i) rest[i] = x[m_.weak[i].column][m_.weak[i].row];
  substitute(x);
  for (std::size_t i = 0; i < n; ++i) rest[i] -= dot(m_.weak[i].coupled, x);
  for (std::size_t i = 0; i < n; ++i) {
    const WeakRow& weak = m_.weak[i];
    double change = 0.0;
    for (std::size_t j = 0; j < n; ++j) change += m_.schur[i * n + j] * rest[j];
    for (std::size_t c = 0; c < x.size(); ++c) {
      for (std::size_t r = 0; r < 3; ++r) x[c][r] -= weak.solved[c][r] * change;
    }
    x[weak.column][weak.row] += change;
  }
}

/// Of the corrections alone: rows that depend on others get the error that the others leave them,
/// or else they would be stressed against each other, by little over little. The stress that there
/// is stays: a bridge without slack that is one body carries its load by it, and its joints would
/// let go of it. Motors and limits may well press against each other.
void JointSolver::reconcile() {
  const auto isError = [&](const SoftenedRow& s) {
    const JointColumn& c = m_.columns[s.column];
    return static_cast<int>(c.row[s.row]) < c.joint->coupled;
  };
  if (std::ranges::none_of(m_.softened, isError)) return;
  auto& x = m_.change;
  x.assign(m_.columns.size(), {});
  for (std::uint32_t c = 0; c < m_.columns.size(); ++c) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(m_.columns[c].rows); ++i) {
      x[c][i] = -rowAt(c, i).bias;
    }
  }
  solve(x);
  for (const SoftenedRow& s : m_.softened) {
    if (!isError(s)) continue;
    const JointColumn& c = m_.columns[s.column];
    const double stress = c.joint->lambda[c.row[s.row]];
    rowAt(s.column, s.row).bias += s.more * (x[s.column][s.row] - stress);
  }
}

}  // namespace merge2d
