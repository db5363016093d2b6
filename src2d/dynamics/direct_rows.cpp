#include "src2d/dynamics/direct_rows.h"

namespace merge2d {
namespace {

BodyMatrix::Vec asVector(const Twist& j) { return {j.vx, j.vy, j.omega}; }

}  // namespace

DirectRows::DirectRows(std::span<const std::uint32_t> bodies, const std::vector<SolverVelocity>& u)
    : u_(u), place_(u.size(), DirectRow::kFixed) {
  for (const std::uint32_t body : bodies) {
    const SolverVelocity& of = u[body];
    place_[body] = static_cast<std::uint32_t>(free_.size());
    free_.push_back({of.vx, of.vy, of.omega});
    mass_.push_back({1.0 / of.inv_mass, 1.0 / of.inv_mass, 1.0 / of.inv_inertia});
  }
}

std::uint32_t DirectRows::add(std::uint32_t a, std::uint32_t b, const Vec2& d, double arm_a,
                              double arm_b, double bias) {
  DirectRow row{place_[a], place_[b], {-d.x(), -d.y(), -arm_a}, {d.x(), d.y(), arm_b}};
  const auto meet = [&](std::uint32_t body, const Twist& j, double& turn) {
    const SolverVelocity& of = u_[body];
    if (place_[body] == DirectRow::kFixed) {
      turn = of.omega;
      row.bias += dot(j, {of.vx, of.vy, of.omega});
    } else {
      row.k += of.inv_mass * (j.vx * j.vx + j.vy * j.vy) + of.inv_inertia * j.omega * j.omega;
    }
  };
  meet(a, row.j_a, row.turn_a);
  meet(b, row.j_b, row.turn_b);
  row.bias += bias;
  rows_.push_back(row);
  return static_cast<std::uint32_t>(rows_.size() - 1);
}

void DirectRows::setArms(std::uint32_t row, double arm_a, double arm_b) {
  DirectRow& r = rows_[row];
  r.bias += r.turn_b * (arm_b - r.j_b.omega) - r.turn_a * (arm_a + r.j_a.omega);
  r.j_a.omega = -arm_a;
  r.j_b.omega = arm_b;
}

double DirectRows::along(std::uint32_t row, const std::vector<Twist>& twists) const {
  const DirectRow& r = rows_[row];
  double w = 0.0;
  if (r.a != DirectRow::kFixed) w += dot(r.j_a, twists[r.a]);
  if (r.b != DirectRow::kFixed) w += dot(r.j_b, twists[r.b]);
  return w;
}

void DirectRows::push(std::uint32_t row, double impulse, std::vector<Twist>& momenta) const {
  const DirectRow& r = rows_[row];
  if (r.a != DirectRow::kFixed) addTo(momenta[r.a], r.j_a, impulse);
  if (r.b != DirectRow::kFixed) addTo(momenta[r.b], r.j_b, impulse);
}

Twist DirectRows::momentum(std::size_t body, const Twist& v) const {
  const Twist& m = mass_[body];
  return {m.vx * v.vx, m.vy * v.vy, m.omega * v.omega};
}

Twist DirectRows::velocity(std::size_t body, const Twist& p) const {
  const Twist& m = mass_[body];
  return {p.vx / m.vx, p.vy / m.vy, p.omega / m.omega};
}

void DirectRows::layOut() {
  for (const DirectRow& row : rows_) {
    if (row.a != DirectRow::kFixed && row.b != DirectRow::kFixed) hessian_.share(row.a, row.b);
  }
  hessian_.layOut(static_cast<std::uint32_t>(mass_.size()));
  for (DirectRow& row : rows_) {
    const bool has_a = row.a != DirectRow::kFixed, has_b = row.b != DirectRow::kFixed;
    if (has_a) row.block_a = hessian_.blockOf(row.a, row.a);
    if (has_b) row.block_b = hessian_.blockOf(row.b, row.b);
    if (has_a && has_b) row.block_ab = hessian_.blockOf(row.a, row.b);
  }
  is_laid_out_ = true;
}

void DirectRows::beginMatrix() {
  if (!is_laid_out_) layOut();
  hessian_.clear();
  for (std::uint32_t i = 0; i < mass_.size(); ++i) hessian_.add(i, asVector(mass_[i]));
}

/// Adds the part of Jᵀ G J of two rows between the same bodies.
void DirectRows::fill(const DirectRow& x, const DirectRow& y, double g) {
  const bool has_a = x.a != DirectRow::kFixed, has_b = x.b != DirectRow::kFixed;
  if (has_a) hessian_.add(x.block_a, asVector(x.j_a), asVector(y.j_a), g);
  if (has_b) hessian_.add(x.block_b, asVector(x.j_b), asVector(y.j_b), g);
  if (!has_a || !has_b) return;
  if (x.a > x.b) {
    hessian_.add(x.block_ab, asVector(x.j_a), asVector(y.j_b), g);
  } else {
    hessian_.add(x.block_ab, asVector(x.j_b), asVector(y.j_a), g);
  }
}

void DirectRows::weigh(std::uint32_t row, double g) { fill(rows_[row], rows_[row], g); }

void DirectRows::weigh(std::uint32_t row, const RowWeights& g) {
  const DirectRow &n = rows_[row], &t = rows_[row + 1];
  fill(n, n, g.nn);
  fill(n, t, g.nt);
  fill(t, n, g.nt);
  fill(t, t, g.tt);
}

bool DirectRows::factorize() { return hessian_.factorize(); }

void DirectRows::solve(const std::vector<Twist>& momenta, std::vector<Twist>& velocities) const {
  std::vector<double> x;
  x.reserve(3 * momenta.size());
  for (const Twist& p : momenta) x.insert(x.end(), {p.vx, p.vy, p.omega});
  hessian_.solve(x);
  velocities.clear();
  for (std::size_t i = 0; i < x.size(); i += 3) velocities.push_back({x[i], x[i + 1], x[i + 2]});
}

}  // namespace merge2d
