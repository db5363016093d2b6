#include "src2d/dynamics/solver.h"

#include <algorithm>

namespace merge2d {
namespace {

void sweep(std::span<ContactBlock> blocks, std::vector<SolverVelocity>& u, SolverMethod method) {
  if (method == SolverMethod::Pgs) {
    for (ContactBlock& k : blocks) solveRows(k, k.nx, k.ny, u[k.a], u[k.b]);
  } else {
    for (ContactBlock& k : blocks) solveBlock(k, k.nx, k.ny, u[k.a], u[k.b]);
  }
}

void warmStart(std::span<const ContactBlock> blocks, std::vector<SolverVelocity>& u) {
  for (const ContactBlock& k : blocks) {
    for (int i = 0; i < k.count; ++i) {
      applyImpulse(k, i, k.nx, k.ny, k.lambda_n[i], k.lambda_t[i], u[k.a], u[k.b]);
    }
  }
}

/// The change of all impulses of a sweep, squared, beside the impulses themselves.
struct Change {
  double squared = 0.0;
  double total = 0.0;
};

Impulses impulsesOf(const ContactBlock& k) {
  return {k.lambda_n[0], k.lambda_n[1], k.lambda_t[0], k.lambda_t[1]};
}

Change changeSince(std::span<const ContactBlock> blocks, std::span<const Impulses> before) {
  Change change;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Impulses now = impulsesOf(blocks[i]);
    for (std::size_t r = 0; r < now.size(); ++r) {
      const double d = now[r] - before[i][r];
      change.squared += d * d;
      change.total += now[r] * now[r];
    }
  }
  return change;
}

/// One island: sweeps, each followed by a step along the conjugate direction p. With g the change
/// that the sweep made (negated), ρ = |g|²/|g₋|²; p is kept beside its effect on the velocities,
/// M⁻¹Jᵀp, so that a step along it costs no pass over the rows' Jacobians.
class IslandSolver {
 public:
  IslandSolver(const SolverSettings& settings, Scratch& scratch, const Island& island)
      : settings_(settings),
        u_(scratch.u),
        blocks_(scratch.blocks.data() + island.first, island.last - island.first),
        bodies_(scratch.island_bodies.data() + island.first_body,
                island.last_body - island.first_body),
        before_(scratch.before.data() + island.first, blocks_.size()),
        direction_(scratch.direction.data() + island.first, blocks_.size()),
        u_before_(scratch.u_before.data() + island.first_body, bodies_.size()),
        u_direction_(scratch.u_direction.data() + island.first_body, bodies_.size()) {}

  Change solve() {
    std::fill(direction_.begin(), direction_.end(), Impulses{});
    std::fill(u_direction_.begin(), u_direction_.end(), Twist{});
    warmStart(blocks_, u_);
    double previous = 0.0;
    Change change;
    for (int k = 0; k < settings_.iterations; ++k) {
      remember();
      sweep(blocks_, u_, settings_.method);
      const bool last = k + 1 == settings_.iterations;
      if (!last && settings_.method != SolverMethod::Nncg) continue;
      change = changeSince(blocks_, before_);
      if (last || change.squared == 0.0) break;
      stepAlong(k == 0 ? 0.0 : change.squared / previous);
      previous = change.squared;
    }
    return change;
  }

 private:
  void remember() {
    for (std::size_t i = 0; i < blocks_.size(); ++i) before_[i] = impulsesOf(blocks_[i]);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const SolverVelocity& u = u_[bodies_[i]];
      u_before_[i] = {u.vx, u.vy, u.omega};
    }
  }

  /// λ += ρp, p = ρp − g; the same for the velocities. A growing change drops p.
  void stepAlong(double rho) {
    const bool restart = rho > 1.0;
    if (restart) rho = 0.0;
    const double keep = restart ? 0.0 : 1.0;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      ContactBlock& k = blocks_[i];
      Impulses& p = direction_[i];
      const Impulses swept = impulsesOf(k);
      for (std::size_t r = 0; r < p.size(); ++r) {
        const double step = rho * p[r];
        p[r] = step + keep * (swept[r] - before_[i][r]);
        (r < 2 ? k.lambda_n[r] : k.lambda_t[r - 2]) += step;
      }
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      SolverVelocity& u = u_[bodies_[i]];
      Twist& p = u_direction_[i];
      const Twist step{rho * p.vx, rho * p.vy, rho * p.omega};
      p = {step.vx + keep * (u.vx - u_before_[i].vx), step.vy + keep * (u.vy - u_before_[i].vy),
           step.omega + keep * (u.omega - u_before_[i].omega)};
      u.vx += step.vx;
      u.vy += step.vy;
      u.omega += step.omega;
    }
  }

  const SolverSettings& settings_;
  std::vector<SolverVelocity>& u_;
  std::span<ContactBlock> blocks_;
  std::span<const std::uint32_t> bodies_;
  std::span<Impulses> before_, direction_;
  std::span<Twist> u_before_, u_direction_;
};

/// Hands the impulses back to the contacts, with the velocities that they leave.
void storeImpulses(const Scratch& scratch) {
  for (std::size_t i = 0; i < scratch.blocks.size(); ++i) {
    const ContactBlock& k = scratch.blocks[i];
    for (int p = 0; p < k.count; ++p) {
      ContactPoint& point = *scratch.row_points[i].point[p];
      const ContactVelocity w =
          contactVelocity(k, p, k.nx, k.ny, scratch.u[k.a], scratch.u[k.b]);
      point.lambda_n = k.lambda_n[p];
      point.lambda_t = k.lambda_t[p];
      point.w_n = w.n;
      point.w_t = w.t;
    }
  }
}

}  // namespace

void solveContacts(State& state, Scratch& scratch) {
  buildRows(state, scratch);
  scratch.before.resize(scratch.blocks.size());
  scratch.direction.resize(scratch.blocks.size());
  scratch.u_before.resize(scratch.island_bodies.size());
  scratch.u_direction.resize(scratch.island_bodies.size());
  Change all;
  for (const Island& island : scratch.islands) {
    const Change change = IslandSolver(state.settings.solver, scratch, island).solve();
    all.squared += change.squared;
    all.total += change.total;
  }
  storeImpulses(scratch);
  scratch.stats.residual = all.total > 0.0 ? std::sqrt(all.squared / all.total) : 0.0;
}

}  // namespace merge2d
