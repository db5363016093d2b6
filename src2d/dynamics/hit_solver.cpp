#include "src2d/dynamics/hit_solver.h"

#include <algorithm>

#include "src2d/dynamics/hit_rows.h"
#include "src2d/dynamics/nncg.h"
#include "src2d/dynamics/point_impact.h"

namespace merge2d {
namespace {

/// The bias with which a limit that is reached ends an approach of `w`; a soft one goes on giving
/// way.
double biasAtLimit(const JointRow& row, double w) {
  if (row.lower != 0.0 && row.upper != 0.0) return -w;  // no way is left
  if (row.softness == 0.0) return 0.0;
  return row.lower == 0.0 ? std::max(0.0, -w) : std::min(0.0, -w);
}

/// A joint keeps the velocity that it has, as far as it is rigid; its motor does not act at once,
/// and its limit where it is reached.
void holdJoint(const HitIsland& island, JointBlock& k) {
  const double gap = island.state().h * std::abs(k.rows[kLimitRow].bias);
  k.limit = k.limit && (k.isAtLimit() || gap <= HitPoint::kMet);
  k.motor = false;
  k.lambda = {};
  k.forEachRow([&](std::size_t i) {
    JointRow& row = k.rows[i];
    const double w = jointVelocity(row, {}, island.u(k.a), island.u(k.b));
    row.bias = i == kLimitRow ? biasAtLimit(row, w) : -w;
  });
}

/// Touches and bears, now that hits have begun.
bool bears(const HitIsland& island, const HitPoint& p) {
  return p.holds && (island.blocks()[p.block].bilateral || p.gap <= p.touching);
}

/// The rows of a block that act.
void solveActive(ContactBlock& k, SolverVelocity& a, SolverVelocity& b) {
  const bool first = k.bias[0] < kNeverActs, second = k.count == 2 && k.bias[1] < kNeverActs;
  if (first == second || k.bilateral) return solveBlock(k, k.nx, k.ny, a, b);
  solvePoint(k, first ? 0 : 1, a, b);
}

}  // namespace

void HitSolver::solve(std::span<HitPoint> points) {
  start_.clear();
  for (const std::uint32_t b : island_.bodies()) start_.push_back(island_.u(b));
  constexpr int kRounds = 4;  // then all that bear are asked
  for (int round = 0; round == 0 || addThoseThatGiveWay(points, round >= kRounds); ++round) {
    returnToStart();
    collectRows(points);
    solveRows(points);
  }
  const double part = weaken(points);
  // Without restitution a point that has met stays in touch, and bears the hits to come.
  for (HitPoint& p : points) p.holds |= p.meets && p.e == 0.0;
  for (const HitPoint& p : points) {
    if (island_.isInner(p.block)) continue;
    island_.pointOf(p).struck += static_cast<float>(part * impulseOf(p));
  }
}

void HitSolver::returnToStart() {
  const auto bodies = island_.bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i) island_.u(bodies[i]) = start_[i];
}

/// Bodies on which the rows of the hit act, and all joints.
void HitSolver::listStruck() {
  struck_.clear();
  const auto add = [&](std::uint32_t rigid) {
    if (island_.u(rigid).inv_mass > 0.0) struck_.push_back(rigid);
  };
  for (const ContactBlock& k : rows_) add(k.a), add(k.b);
  for (const JointBlock& k : joints_) add(k.a), add(k.b);
  std::ranges::sort(struck_);
  struck_.erase(std::unique(struck_.begin(), struck_.end()), struck_.end());
}

void HitSolver::collectRows(std::span<HitPoint> points) {
  rows_.clear();
  for (std::size_t i = 0; i < points.size();) {
    std::size_t end = i;
    bool meets = false;
    for (; end < points.size() && points[end].block == points[i].block; ++end) {
      meets |= points[end].meets;
    }
    if (meets) rows_.push_back(rowsOf(points[i].block));
    for (; i < end; ++i) {
      HitPoint& p = points[i];
      p.rows = meets ? static_cast<std::int32_t>(rows_.size()) - 1 : -1;
      if (meets) rows_.back().bias[p.row] = p.meets ? -p.target : kNeverActs;
    }
  }
}

/// The rows of a block without softness and impulses.
ContactBlock HitSolver::rowsOf(std::uint32_t block) const {
  ContactBlock k = island_.blocks()[block];
  k.lambda = {};
  fillMasses(k, 0.0, island_.u(k.a), island_.u(k.b));
  return k;
}

/// True when there were some among those that touch and bear.
bool HitSolver::addThoseThatGiveWay(std::span<HitPoint> points, bool all) const {
  bool gives = false;
  for (HitPoint& p : points) {
    if (p.meets || !bears(island_, p)) continue;
    const double w = island_.velocityOf(p) - p.target;
    p.meets = island_.blocks()[p.block].bilateral ? std::abs(w) > HitPoint::kStill : w < -p.still;
    gives |= p.meets;
  }
  for (HitPoint& p : points) p.meets |= gives && all && bears(island_, p);
  return gives;
}

void HitSolver::solveRows(std::span<const HitPoint> points) {
  joints_.assign(island_.joints().begin(), island_.joints().end());
  listStruck();
  for (JointBlock& k : joints_) holdJoint(island_, k);
  Nncg iteration(
      rows_.size() + joints_.size(),
      [&](std::size_t i) -> Impulses& {
        return i < rows_.size() ? rows_[i].lambda : joints_[i - rows_.size()].lambda;
      },
      struck_.size(), [&](std::size_t i) -> SolverVelocity& { return island_.u(struck_[i]); },
      [&] {
        for (JointBlock& k : joints_) solveJoint(k, {}, island_.u(k.a), island_.u(k.b));
        for (ContactBlock& k : rows_) solveActive(k, island_.u(k.a), island_.u(k.b));
      },
      island_.scratch().sweeps.front().nncg);
  constexpr std::size_t kFewRows = 8;
  constexpr double kExact = 1e-13, kClose = 1e-7;
  const bool bounces = std::ranges::any_of(
      points, [](const HitPoint& p) { return p.meets && p.target > p.allowed; });
  iteration.endBelow(bounces ? kExact : kClose);
  const bool alone = rows_.size() == 1 && joints_.empty();
  iteration.run(alone ? 2 : rows_.size() <= kFewRows ? 60 : 20, !alone);
}

double HitSolver::impulseOf(const HitPoint& p) const {
  return p.rows < 0 ? 0.0 : rows_[static_cast<std::size_t>(p.rows)].lambda_n(p.row);
}

const SolverVelocity& HitSolver::before(std::uint32_t rigid) const {
  const std::uint32_t place = island_.placeOf(rigid);
  return place == HitIsland::kFixed ? island_.u(rigid) : start_[place];
}

/// The kinetic energy of the island before the hit [J].
double HitSolver::energyBefore() const {
  double energy = 0.0;
  for (const SolverVelocity& v : start_) {
    energy += 0.5 * (v.vx * v.vx + v.vy * v.vy) / v.inv_mass;
    if (v.inv_inertia > 0.0) energy += 0.5 * v.omega * v.omega / v.inv_inertia;
  }
  return energy;
}

HitSolver::Work HitSolver::workOfContacts() const {
  Work work;
  for (const ContactBlock& k : rows_) {
    const SolverVelocity &a = island_.u(k.a), &b = island_.u(k.b);
    const SolverVelocity &old_a = before(k.a), &old_b = before(k.b);
    for (int i = 0; i < k.count; ++i) {
      const ContactVelocity now = contactVelocity(k, i, k.nx, k.ny, a, b);
      const ContactVelocity was = contactVelocity(k, i, k.nx, k.ny, old_a, old_b);
      work.add(k.lambda_n(i), was.n, now.n);
      work.add(k.lambda_t(i), was.t, now.t);
    }
    work.add(k.lambda_r(), old_b.omega - old_a.omega, b.omega - a.omega);
  }
  return work;
}

HitSolver::Work HitSolver::workOfJoints(bool of_limits) const {
  Work work;
  for (const JointBlock& k : joints_) {
    k.forEachRow([&](std::size_t i) {
      if ((i == kLimitRow) != of_limits) return;
      work.add(k.lambda[i], jointVelocity(k.rows[i], {}, before(k.a), before(k.b)),
               jointVelocity(k.rows[i], {}, island_.u(k.a), island_.u(k.b)));
    });
  }
  return work;
}

/// Takes back the energy that the impulses would add. Where all of them are multiplied by `part`,
/// the energy changes by part λ·w⁻ + part²/2 λ·Kλ. Returns that part.
double HitSolver::weaken(std::span<const HitPoint> points) {
  Work work = workOfContacts();
  work.add(workOfJoints(true));
  // A slow hit may do less work than the errors of joints that are put right meanwhile. Where that
  // is little, too, it is no reason to leave the hit out.
  constexpr double kLittle = 1e-6;  // of the energy of the island
  const Work rigid = workOfJoints(false);
  if (work.along + rigid.along < 0.0 || rigid.along > kLittle * energyBefore()) work.add(rigid);
  const auto [along, change] = work;
  double by_loads = 0.0;
  for (const HitPoint& p : points) by_loads += 0.5 * impulseOf(p) * p.extra;
  if (change <= by_loads + 1e-14 * std::abs(along) || change <= along) return 1.0;
  const double part = std::clamp((by_loads - along) / (change - along), 0.0, 1.0);
  const auto bodies = island_.bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    SolverVelocity& v = island_.u(bodies[i]);
    const SolverVelocity& old = start_[i];
    v.vx = old.vx + part * (v.vx - old.vx);
    v.vy = old.vy + part * (v.vy - old.vy);
    v.omega = old.omega + part * (v.omega - old.omega);
  }
  return part;
}

}  // namespace merge2d
