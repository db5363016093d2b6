#pragma once
/// The primal-dual interior point method of dynamics/newton.h.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "src2d/dynamics/bounded_impulse.h"
#include "src2d/dynamics/contact_limits.h"
#include "src2d/dynamics/direct_rows.h"
#include "src2d/dynamics/state.h"

namespace merge2d {

/// All rows of an island, and where their solve stands.
class InteriorPoint {
 public:
  static constexpr int kMostSteps = 50;

  InteriorPoint(std::span<const std::uint32_t> bodies, const std::vector<SolverVelocity>& u)
      : u_(u), rows_(bodies, u) {}

  void addBlock(const ContactBlock& k) {
    const Vec2 n(k.nx, k.ny), t(-k.ny, k.nx);
    const double belts = u_[k.a].surface + u_[k.b].surface;
    if (k.count == 2 && !k.bilateral && k.hits == 0) {
      pairs_.push_back({&k, static_cast<std::uint32_t>(groups_.size())});
    }
    for (int i = 0; i < k.count; ++i) {
      const bool is_hit = (k.hits >> i & 1) != 0;
      const auto normal =
          rows_.add(k.a, k.b, n, k.arm_an[i], k.arm_bn[i], is_hit ? 0.0 : k.bias[i]);
      const auto tangent = rows_.add(k.a, k.b, t, k.arm_at[i], k.arm_bt[i], belts);
      if (is_hit) {
        addImpulse(normal, k.softness, 0.0, 0.0, 0.0);
        addImpulse(tangent, 0.0, 0.0, 0.0, 0.0);
      } else if (k.bilateral) {
        addImpulse(normal, k.softness, -kUnbounded, kUnbounded, k.lambda_n(i));
        addImpulse(tangent, 0.0, -kUnbounded, kUnbounded, k.lambda_t(i));
      } else {
        addCone(normal, k, i);
      }
    }
    if (!k.rolls()) return;
    const double most = k.rolling() * std::max(0.0, k.lambda_n(0));  // of the load of the last step
    const auto row = rows_.add(k.a, k.b, Vec2::Zero(), 1.0, 1.0, 0.0);
    addImpulse(row, 0.0, -most, most, k.lambda_r());
  }

  void addJoint(const JointBlock& k) {
    k.forEachRow([&](std::size_t i) {
      const JointRow& of = k.rows[i];
      const auto row = rows_.add(k.a, k.b, {of.dx, of.dy}, of.arm_a, of.arm_b, of.bias);
      const bool bounded = i >= static_cast<std::size_t>(k.coupled);
      addImpulse(row, of.softness, bounded ? of.lower : -kUnbounded,
                 bounded ? of.upper : kUnbounded, k.lambda[i]);
    });
  }

  std::size_t unknowns() const { return unknowns_.size(); }
  bool converged() const { return converged_; }

  /// Takes some steps. True where that was the last one.
  bool run(double tolerance, NewtonIterate& iterate, int most_steps) {
    iterate.unknowns.empty() ? start(tolerance) : swapWith(iterate);
    for (int step = 0;; ++step, ++iterate.steps) {
      converged_ = findErrors() <= exact_;
      if (converged_ || iterate.steps == kMostSteps) break;
      if (step == most_steps) {
        swapWith(iterate);
        return false;
      }
      if (!factorize()) break;
      findStep(0.0, false);
      const double affine = meanProduct(longest(1.0)) / meanProduct(0.0);
      const double target = affine * affine * affine * meanProduct(0.0);
      findStep(target, true);
      move(longest(kInside));
    }
    snap();
    return true;
  }

  void takeImpulses(ContactBlock& k) {
    for (int i = 0; i < k.count; ++i) {
      const double first = unknowns_[next_++].x, second = unknowns_[next_++].x;
      k.lambda_n(i) = k.bilateral ? first : first + second;
      k.lambda_t(i) = k.bilateral ? second : k.mu * (first - second);
    }
    if (k.count == 2) {
      const ManifoldFriction f(k);
      const double friction = k.lambda_t(0) + k.lambda_t(1);
      for (int i = 0; i < 2; ++i) k.lambda_t(i) = f.part[i] * friction;
    }
    if (k.rolls()) k.lambda[3] = unknowns_[next_++].x;
  }
  void takeImpulses(JointBlock& k) {
    k.forEachRow([&](std::size_t i) { k.lambda[i] = unknowns_[next_++].x; });
  }

 private:
  static constexpr double kRigid = 1e-8;  ///< softness of a rigid row, of its K
  static constexpr double kExact =
      1e-7;  ///< velocity that is left, of the fastest without impulses
  static constexpr double kInside =
      0.99;  ///< part of the way to the nearest bound that a step goes

  /// Two points whose friction acts where their pressure has its centre.
  struct PointPair {
    const ContactBlock* block;
    std::uint32_t group;  ///< of the first point
  };

  void swapWith(NewtonIterate& iterate) {
    std::swap(unknowns_, iterate.unknowns);
    std::swap(u_now_, iterate.u);
    std::swap(exact_, iterate.exact);
  }

  RowGroup& addGroup(std::uint32_t row, double softness) {
    const auto unknown = static_cast<std::uint32_t>(unknowns_.size());
    const double soft = std::max(softness, kRigid * rows_[row].k);
    groups_.push_back({.row = row, .unknown = unknown, .softness = soft});
    return groups_.back();
  }

  void addCone(std::uint32_t normal, const ContactBlock& k, int i) {
    addGroup(normal, k.softness).mu = k.mu;
    const double half = 0.5 * k.lambda_n(i), along = k.mu > 0.0 ? 0.5 * k.lambda_t(i) / k.mu : 0.0;
    for (const double x : {half + along, half - along}) unknowns_.emplace_back().x = x;
  }

  void addImpulse(std::uint32_t row, double softness, double lower, double upper, double x) {
    RowGroup& group = addGroup(row, softness);
    group.lower = lower;
    group.upper = upper;
    unknowns_.emplace_back().x = std::clamp(x, lower, upper);
  }

  /// The velocities along the unknowns of a group that the twists of the bodies give.
  std::array<double, 2> along(const RowGroup& g, const std::vector<Twist>& twists) const {
    const double n = rows_.along(g.row, twists);
    if (!g.isCone()) return {n, 0.0};
    const double t = g.mu * rows_.along(g.row + 1, twists);
    return {n + t, n - t};
  }
  std::array<double, 2> bias(const RowGroup& g) const {
    const double n = rows_[g.row].bias;
    if (!g.isCone()) return {n, 0.0};
    const double t = g.mu * rows_[g.row + 1].bias;
    return {n + t, n - t};
  }
  void push(const RowGroup& g, double x, double y, std::vector<Twist>& momenta) const {
    if (!g.isCone()) return rows_.push(g.row, x, momenta);
    rows_.push(g.row, x + y, momenta);
    rows_.push(g.row + 1, g.mu * (x - y), momenta);
  }

  /// Calls `visit(group, i, unknown)` for the unknowns that are free.
  template <class Visit>
  void forEachUnknown(Visit&& visit) {
    for (const RowGroup& g : groups_) {
      if (!g.isFree()) continue;
      for (std::uint32_t i = 0; i < g.size(); ++i) visit(g, i, unknowns_[g.unknown + i]);
    }
  }

  /// The velocities under the impulses that there are, and how far all bounds are kept from at
  /// first: as far as these impulses are from a solution.
  void start(double tolerance) {
    const std::vector<Twist>& free = rows_.freeVelocities();
    momenta_.assign(rows_.bodies(), {});
    for (const RowGroup& g : groups_) {
      push(g, unknowns_[g.unknown].x, g.isCone() ? unknowns_[g.unknown + 1].x : 0.0, momenta_);
    }
    u_now_ = free;
    for (std::size_t i = 0; i < u_now_.size(); ++i)
      addTo(u_now_[i], rows_.velocity(i, momenta_[i]), 1.0);
    double fastest = 0.0;  // without impulses or with those: a brake may bear a load that has gone
    for (const RowGroup& g : groups_) {
      const auto w = along(g, free), now = along(g, u_now_), b = bias(g);
      for (std::uint32_t i = 0; i < g.size(); ++i) {
        fastest = std::max({fastest, std::abs(w[i] + b[i]), std::abs(now[i] + b[i])});
      }
    }
    exact_ = std::max(tolerance, kExact * fastest);
    double off = 0.0;
    forEachUnknown([&](const RowGroup& g, std::uint32_t i, BoundedImpulse& x) {
      off = std::max(off, residualOf(g, x, along(g, u_now_)[i] + bias(g)[i]));
    });
    off = std::clamp(off, exact_, std::max(exact_, fastest));
    forEachUnknown([&](const RowGroup& g, std::uint32_t i, BoundedImpulse& x) {
      startInside(g, x, along(g, u_now_)[i] + bias(g)[i], off);
    });
  }

  /// Each friction as in a sweep (ManifoldFriction), with the pressure that there is by now.
  void aimFriction() {
    for (const PointPair& m : pairs_) {
      ContactBlock k = *m.block;
      for (std::uint32_t i = 0; i < 2; ++i) {
        const BoundedImpulse* x = &unknowns_[groups_[m.group + i].unknown];
        k.lambda_n(static_cast<int>(i)) = x[0].x + x[1].x;
      }
      const ManifoldFriction friction(k);
      for (std::uint32_t i = 0; i < 2; ++i) {
        rows_.setArms(groups_[m.group + i].row + 1, friction.arm_a, friction.arm_b);
      }
    }
  }

  /// By how much a velocity w misses what its impulse and its bounds allow.
  double residualOf(const RowGroup& g, const BoundedImpulse& x, double w) const {
    const double k = rows_[g.row].k;
    return std::abs(x.x - std::clamp(x.x - w / k, g.lower, g.upper)) * k;
  }

  void startInside(const RowGroup& g, BoundedImpulse& x, double w, double off) {
    const double margin = std::min(off / rows_[g.row].k, 0.5 * (g.upper - g.lower));
    x.low.exists = g.lower > -kUnbounded;
    x.high.exists = g.upper < kUnbounded;
    if (x.low.exists) x.x = std::max(x.x, g.lower + margin);
    if (x.high.exists) x.x = std::min(x.x, g.upper - margin);
    if (x.low.exists) x.low.gap = x.x - g.lower, x.low.slack = std::max(w, off);
    if (x.high.exists) x.high.gap = g.upper - x.x, x.high.slack = std::max(-w, off);
  }

  /// The errors of all equations; returns the largest velocity by which one misses [m/s].
  double findErrors() {
    double most = 0.0;
    aimFriction();
    momenta_.assign(rows_.bodies(), {});
    for (const RowGroup& g : groups_) {
      BoundedImpulse *x = &unknowns_[g.unknown], *y = g.isCone() ? x + 1 : nullptr;
      push(g, x->x, y ? y->x : 0.0, momenta_);
      if (!g.isFree()) continue;
      const auto w = along(g, u_now_), b = bias(g);
      const double soft = g.softness * (x->x + (y ? y->x : 0.0));
      const double steep = g.mu > 0.0 ? std::min(1.0, g.mu) : 1.0;  // of the tangent
      for (std::uint32_t i = 0; i < g.size(); ++i) {
        BoundedImpulse& of = x[i];
        of.error = w[i] + b[i] + soft;
        if (of.low.exists) of.error -= of.low.slack;
        if (of.high.exists) of.error += of.high.slack;
        most = std::max(most, std::abs(of.error) / steep);
        of.forEachBound([&](const Bound& bound) {
          most = std::max(most, std::min(bound.slack, rows_[g.row].k * bound.gap) / steep);
        });
      }
    }
    for (std::size_t i = 0; i < momenta_.size(); ++i) {
      Twist v = rows_.freeVelocities()[i];
      addTo(v, rows_.velocity(i, momenta_[i]), 1.0);
      addTo(v, u_now_[i], -1.0);
      momenta_[i] = rows_.momentum(i, v);
      most = std::max({most, std::abs(v.vx), std::abs(v.vy)});
    }
    return most;
  }

  /// (C + Z)⁻¹ of each group, with the softness C and the bounds' stiffness Z.
  bool factorize() {
    rows_.beginMatrix();
    for (RowGroup& g : groups_) {
      if (!g.isFree()) continue;
      const BoundedImpulse* x = &unknowns_[g.unknown];
      const double c = g.softness, z = x->stiffness();
      if (!g.isCone()) {
        g.inverse = {1.0 / (c + z), 0.0, 0.0};
        rows_.weigh(g.row, g.inverse[0]);
        continue;
      }
      const double z_y = x[1].stiffness(), det = z * z_y + c * (z + z_y);
      g.inverse = {(c + z_y) / det, -c / det, (c + z) / det};
      const double sum = (z + z_y) / det;
      rows_.weigh(g.row, {sum, g.mu * (z_y - z) / det, g.mu * g.mu * (sum + 4.0 * c / det)});
    }
    return rows_.factorize();
  }

  /// The step to where all products of bounds are `target`; with the second-order part of the step
  /// found before.
  void findStep(double target, bool corrects) {
    std::vector<Twist>& rhs = direction_;
    rhs = momenta_;
    for (const RowGroup& g : groups_) {
      if (!g.isFree()) continue;
      BoundedImpulse* x = &unknowns_[g.unknown];
      for (std::uint32_t i = 0; i < g.size(); ++i) {
        x[i].rhs = -x[i].error;
        if (x[i].low.exists) x[i].rhs += x[i].low.wanted(target, corrects) / x[i].low.gap;
        if (x[i].high.exists) x[i].rhs -= x[i].high.wanted(target, corrects) / x[i].high.gap;
      }
      const auto [p, q] = timesInverse(g, x[0].rhs, g.isCone() ? x[1].rhs : 0.0);
      push(g, p, q, rhs);
    }
    rows_.solve(rhs, direction_);
    for (const RowGroup& g : groups_) {
      if (!g.isFree()) continue;
      BoundedImpulse* x = &unknowns_[g.unknown];
      const auto w = along(g, direction_);
      const auto d = timesInverse(g, x[0].rhs - w[0], g.isCone() ? x[1].rhs - w[1] : 0.0);
      for (std::uint32_t i = 0; i < g.size(); ++i) stepBounds(x[i], d[i], target, corrects);
    }
  }

  static std::array<double, 2> timesInverse(const RowGroup& g, double p, double q) {
    const auto& [first, cross, second] = g.inverse;
    return {first * p + cross * q, cross * p + second * q};
  }

  static void stepBounds(BoundedImpulse& x, double d, double target, bool corrects) {
    const auto step = [&](Bound& bound, double d_gap) {
      bound.d_slack = (bound.wanted(target, corrects) - bound.slack * d_gap) / bound.gap;
      bound.d_gap = d_gap;
    };
    if (x.low.exists) step(x.low, d);
    if (x.high.exists) step(x.high, -d);
    x.rhs = d;
  }

  /// The longest step along the direction, at most 1, that goes this part of the way to a bound.
  double longest(double inside) {
    double s = 1.0;
    forEachUnknown([&](const RowGroup&, std::uint32_t, const BoundedImpulse& x) {
      x.forEachBound([&](const Bound& b) {
        if (b.d_gap < 0.0) s = std::min(s, -inside * b.gap / b.d_gap);
        if (b.d_slack < 0.0) s = std::min(s, -inside * b.slack / b.d_slack);
      });
    });
    return s;
  }

  double meanProduct(double s) {
    double sum = 0.0, count = 1e-300;
    forEachUnknown([&](const RowGroup&, std::uint32_t, const BoundedImpulse& x) {
      x.forEachBound([&](const Bound& b) {
        sum += b.product(s);
        ++count;
      });
    });
    return sum / count;
  }

  void move(double s) {
    forEachUnknown([&](const RowGroup&, std::uint32_t, BoundedImpulse& x) {
      x.x += s * x.rhs;
      x.forEachBound([&](Bound& b) {
        b.gap += s * b.d_gap;
        b.slack += s * b.d_slack;
      });
    });
    for (std::size_t i = 0; i < u_now_.size(); ++i) addTo(u_now_[i], direction_[i], s);
  }

  /// Puts an impulse on its bound where it is nearer to that, in velocities, than the slack to
  /// zero.
  void snap() {
    forEachUnknown([&](const RowGroup& g, std::uint32_t, BoundedImpulse& x) {
      const double k = rows_[g.row].k;
      if (x.low.exists && k * x.low.gap < x.low.slack) x.x = g.lower;
      if (x.high.exists && k * x.high.gap < x.high.slack) x.x = g.upper;
    });
  }

  const std::vector<SolverVelocity>& u_;
  DirectRows rows_;
  std::vector<RowGroup> groups_;
  std::vector<PointPair> pairs_;
  std::vector<BoundedImpulse> unknowns_;
  std::vector<Twist> u_now_, momenta_, direction_;
  double exact_ = 0.0;
  bool converged_ = false;
  std::size_t next_ = 0;
};

}  // namespace merge2d
