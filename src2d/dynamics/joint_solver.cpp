#include "src2d/dynamics/joint_solver.h"

#include <algorithm>

#include "src2d/dynamics/joint_matrix.h"

namespace merge2d {
namespace {

/// A pivot below this part of its row's K is weak: an error of its row moves bodies by 30 times as
/// much and more.
constexpr double kWeak = 1e-3;

/// More weak rows than these are solved in their order: their matrix is dense.
constexpr std::size_t kMostWeakRows = 64;

/// Motor or limit, where one of them is inside its bounds. A motor that presses against a limit
/// wants a motion that the limit forbids: the limit holds.
int boundRowOf(const JointBlock& k) {
  if (k.coupled > 2) return -1;
  if (k.limit && k.isWithinBounds(kLimitRow)) return kLimitRow;
  if (k.motor && k.isWithinBounds(kMotorRow)) return kMotorRow;
  return -1;
}

/// x −= a · bᵀ
void subtract(JointMatrix& x, const JointMatrix& a, const JointMatrix& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      x[i][j] -= a[i][0] * b[j][0] + a[i][1] * b[j][1] + a[i][2] * b[j][2];
    }
  }
}

JointMatrix product(const JointMatrix& a, const JointMatrix& b) {
  JointMatrix x{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      x[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    }
  }
  return x;
}

}  // namespace

JointSolver::JointSolver(std::span<JointBlock> joints, std::vector<SolverVelocity>& u,
                         JointMemory& memory)
    : joints_(joints), u_(u), m_(memory), pattern_(patternOf()) {
  chooseRows();
  factorise();
  reconcile();
}

/// Islands come in the same order in each step, and most of them unchanged.
const JointPattern& JointSolver::patternOf() {
  m_.ends.clear();
  for (const JointBlock& k : joints_) {
    const auto end = [&](std::uint32_t body) { return u_[body].inv_mass > 0.0 ? body : kFixedEnd; };
    m_.ends.emplace_back(end(k.a), end(k.b));
  }
  const std::size_t at = m_.next++;
  if (at == m_.patterns.size()) m_.patterns.emplace_back();
  if (m_.patterns[at].ends != m_.ends) m_.patterns[at] = eliminationPattern(m_.ends);
  return m_.patterns[at];
}

void JointSolver::chooseRows() {
  m_.columns.clear();
  m_.bound_row.assign(joints_.size(), -1);
  for (const std::uint32_t joint : pattern_.order) {
    JointBlock& k = joints_[joint];
    JointColumn& c = m_.columns.emplace_back();
    c.joint = &k;
    for (; c.rows < k.coupled; ++c.rows) {
      c.row[static_cast<std::size_t>(c.rows)] = static_cast<std::uint8_t>(c.rows);
    }
    const int bound = boundRowOf(k);
    if (bound < 0) continue;
    c.row[static_cast<std::size_t>(c.rows++)] = static_cast<std::uint8_t>(bound);
    m_.bound_row[joint] = static_cast<std::int8_t>(bound);
  }
}

JointMatrix JointSolver::coupling(const JointColumn& x, const JointColumn& y) const {
  JointMatrix k{};
  const auto add = [&](std::uint32_t body, double sign, bool b_of_x, bool b_of_y) {
    const SolverVelocity& m = u_[body];
    for (std::size_t i = 0; i < static_cast<std::size_t>(x.rows); ++i) {
      const JointRow& r = x.joint->rows[x.row[i]];
      for (std::size_t j = 0; j < static_cast<std::size_t>(y.rows); ++j) {
        const JointRow& s = y.joint->rows[y.row[j]];
        const double turns = (b_of_x ? r.arm_b : r.arm_a) * (b_of_y ? s.arm_b : s.arm_a);
        k[i][j] += sign * (m.inv_mass * (r.dx * s.dx + r.dy * s.dy) + m.inv_inertia * turns);
      }
    }
  };
  const JointBlock &p = *x.joint, &q = *y.joint;
  if (p.a == q.a) add(p.a, 1.0, false, false);
  if (p.a == q.b) add(p.a, -1.0, false, true);
  if (p.b == q.a) add(p.b, -1.0, true, false);
  if (p.b == q.b) add(p.b, 1.0, true, true);
  return k;
}

JointMatrix JointSolver::diagonalOf(const JointColumn& c) const {
  JointMatrix k = coupling(c, c);
  for (std::size_t i = 0; i < 3; ++i) {
    const bool there = i < static_cast<std::size_t>(c.rows);
    k[i][i] += there ? c.joint->rows[c.row[i]].softness : 1.0;
  }
  return k;
}

JointRow& JointSolver::rowAt(std::uint32_t column, std::size_t row) {
  JointColumn& c = m_.columns[column];
  return c.joint->rows[c.row[row]];
}

void JointSolver::soften(std::uint32_t column, std::size_t row, double more) {
  if (row >= static_cast<std::size_t>(m_.columns[column].rows)) return;
  m_.softened.push_back({column, row, more});
  rowAt(column, row).softness += more;
}

/// Of a symmetric matrix, by Gauss-Jordan elimination. The row that says most beyond those before
/// it comes next, as among weak rows. Rows that are solved later are left out, as rows of zeros.
JointMatrix JointSolver::inverseOf(JointMatrix k, std::uint32_t column) {
  JointColumn& c = m_.columns[column];
  const JointMatrix own = diagonalOf(c);
  std::array<bool, 3> done{}, deferred{};
  const auto left = [&](std::size_t i) { return k[i][i] / own[i][i]; };
  for (std::size_t n = 0; n < 3; ++n) {
    const std::size_t i = strongestRow(3, left, [&](std::size_t r) { return done[r]; });
    done[i] = true;
    const bool dependent = left(i) <= kDependent, weak = left(i) < kWeak;
    has_dependent_ |= dependent;
    has_weak_ |= weak && !dependent;
    deferred[i] = weak && defers_;
    if (deferred[i]) {
      m_.weak.push_back({.column = column, .row = i, .own = own[i][i], .coupled{}, .solved{}});
      continue;
    }
    if (dependent) soften(column, i, k[i][i] = kSoftened * own[i][i]);
    exchangeRow([&](std::size_t r, std::size_t s) -> double& { return k[r][s]; }, 3, i);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (deferred[i] || deferred[j]) k[i][j] = 0.0;
    }
  }
  return k;
}

JointMatrix& JointSolver::blockAt(std::uint32_t row, std::uint32_t column) {
  const auto begin = pattern_.rows.begin() + pattern_.first[column];
  const auto end = pattern_.rows.begin() + pattern_.first[column + 1];
  return m_
      .lower[static_cast<std::size_t>(std::lower_bound(begin, end, row) - pattern_.rows.begin())];
}

void JointSolver::factorise() {
  defers_ = false;
  m_.weak.clear();
  m_.softened.clear();
  factoriseColumns();
  if (!has_weak_ || !has_dependent_) return;
  for (const SoftenedRow& s : m_.softened) rowAt(s.column, s.row).softness -= s.more;
  m_.softened.clear();
  defers_ = true;
  factoriseColumns();
  if (m_.weak.size() <= kMostWeakRows) {
    factoriseWeakRows();
    return;
  }
  defers_ = false;
  m_.weak.clear();
  factoriseColumns();
}

void JointSolver::factoriseColumns() {
  has_weak_ = has_dependent_ = false;
  m_.inverse.resize(m_.columns.size());
  m_.lower.resize(pattern_.rows.size());
  for (std::uint32_t c = 0; c < m_.columns.size(); ++c) {
    m_.inverse[c] = diagonalOf(m_.columns[c]);
    for (std::uint32_t e = pattern_.first[c]; e < pattern_.first[c + 1]; ++e) {
      m_.lower[e] = coupling(m_.columns[pattern_.rows[e]], m_.columns[c]);
    }
  }
  for (std::uint32_t c = 0; c < m_.columns.size(); ++c) eliminate(c);
}

/// Turns K of a column into D⁻¹ and L, and subtracts its update from the columns that follow.
void JointSolver::eliminate(std::uint32_t column) {
  const JointMatrix inverse = inverseOf(m_.inverse[column], column);
  m_.inverse[column] = inverse;
  const std::uint32_t begin = pattern_.first[column], end = pattern_.first[column + 1];
  for (std::uint32_t e = begin; e < end; ++e) {
    const JointMatrix l = product(m_.lower[e], inverse);
    // Blocks after this one still hold L D, those before it L: each pair is met once.
    subtract(m_.inverse[pattern_.rows[e]], l, m_.lower[e]);
    for (std::uint32_t f = e + 1; f < end; ++f) {
      subtract(blockAt(pattern_.rows[f], pattern_.rows[e]), m_.lower[f], l);
    }
    m_.lower[e] = l;
  }
}

/// Solves for the residuals of the rows.
void JointSolver::findChange() {
  auto& x = m_.change;
  x.assign(m_.columns.size(), {});
  for (std::size_t c = 0; c < m_.columns.size(); ++c) {
    const JointColumn& column = m_.columns[c];
    const JointBlock& k = *column.joint;
    for (std::size_t i = 0; i < static_cast<std::size_t>(column.rows); ++i) {
      x[c][i] = -jointRest(k, column.row[i], {}, u_[k.a], u_[k.b]);
    }
  }
  solve(x);
}

void JointSolver::solve(std::vector<JointVector>& x) {
  if (m_.weak.empty()) {
    substitute(x);
  } else {
    addWeakRows(x);
  }
}

/// x = A⁻¹ x, with zeros in the rows that are solved later.
void JointSolver::substitute(std::vector<JointVector>& x) const {
  const auto forEachBlock = [&](std::size_t c, auto&& f) {
    for (std::uint32_t e = pattern_.first[c]; e < pattern_.first[c + 1]; ++e) {
      f(m_.lower[e], x[pattern_.rows[e]]);
    }
  };
  for (std::size_t c = 0; c < x.size(); ++c) {
    forEachBlock(c, [&](const JointMatrix& l, JointVector& below) {
      for (std::size_t i = 0; i < 3; ++i) {
        below[i] -= l[i][0] * x[c][0] + l[i][1] * x[c][1] + l[i][2] * x[c][2];
      }
    });
  }
  for (std::size_t c = x.size(); c-- > 0;) {
    const JointMatrix& d = m_.inverse[c];
    JointVector y{};
    for (std::size_t i = 0; i < 3; ++i) {
      y[i] = d[i][0] * x[c][0] + d[i][1] * x[c][1] + d[i][2] * x[c][2];
    }
    forEachBlock(c, [&](const JointMatrix& l, const JointVector& below) {
      for (std::size_t i = 0; i < 3; ++i) {
        y[i] -= l[0][i] * below[0] + l[1][i] * below[1] + l[2][i] * below[2];
      }
    });
    x[c] = y;
  }
}

/// A motor or a limit whose impulse would exceed its bound gets the impulse at the bound, and is no
/// equation any more. True if there was one.
bool JointSolver::dropWhatIsBeyondItsBounds() {
  bool any = false;
  for (std::size_t c = 0; c < m_.columns.size(); ++c) {
    JointColumn& column = m_.columns[c];
    JointBlock& k = *column.joint;
    if (column.rows == k.coupled) continue;
    const auto last = static_cast<std::size_t>(column.rows - 1);
    const std::size_t row = column.row[last];
    JointRow& r = k.rows[row];
    const double wanted = k.lambda[row] + m_.change[c][last];
    if (wanted >= r.lower && wanted <= r.upper) continue;
    const double p = std::clamp(wanted, r.lower, r.upper) - k.lambda[row];
    applyJointImpulse(r, {}, p, u_[k.a], u_[k.b]);
    k.lambda[row] += p;
    column.rows = k.coupled;
    m_.bound_row[static_cast<std::size_t>(&k - joints_.data())] = -1;
    any = true;
  }
  return any;
}

void JointSolver::applyChange() {
  for (std::size_t c = 0; c < m_.columns.size(); ++c) {
    const JointColumn& column = m_.columns[c];
    JointBlock& k = *column.joint;
    for (std::size_t i = 0; i < static_cast<std::size_t>(column.rows); ++i) {
      const double p = m_.change[c][i];
      applyJointImpulse(k.rows[column.row[i]], {}, p, u_[k.a], u_[k.b]);
      k.lambda[column.row[i]] += p;
    }
  }
}

bool JointSolver::solvesBound(const JointBlock& k, std::size_t row) const {
  return m_.bound_row[static_cast<std::size_t>(&k - joints_.data())] == static_cast<int>(row);
}

bool JointSolver::isExact() const {
  return pattern_.left_out.empty() && std::ranges::all_of(joints_, [&](const JointBlock& k) {
           return (!k.motor || solvesBound(k, kMotorRow)) &&
                  (!k.limit || solvesBound(k, kLimitRow));
         });
}

void JointSolver::correct() {
  for (JointBlock& k : joints_) {
    k.forEachRow([&](std::size_t i) {
      JointRow& r = k.rows[i];
      const double error = i < static_cast<std::size_t>(k.coupled) ? r.bias : 0.0;
      r.bias = error - r.softness * k.lambda[i] - jointVelocity(r, {}, u_[k.a], u_[k.b]);
    });
  }
  findChange();
  applyChange();
}

void JointSolver::sweep() {
  for (JointBlock& k : joints_) {
    for (const std::size_t row : {kMotorRow, kLimitRow}) {
      if ((row == kMotorRow ? k.motor : k.limit) && !solvesBound(k, row)) {
        solveJointBound(k, row, {}, u_[k.a], u_[k.b]);
      }
    }
  }
  for (const std::uint32_t joint : pattern_.left_out) {
    JointBlock& k = joints_[joint];
    solveJointTogether(k, {}, u_[k.a], u_[k.b]);
  }
  findChange();
  while (dropWhatIsBeyondItsBounds()) {
    factorise();
    findChange();
  }
  applyChange();
}

}  // namespace merge2d
