#pragma once
/// Nonsmooth nonlinear conjugate gradient around sweeps of PGS.
///
/// Source: Silcowitz-Hansen, Niebe, Erleben 2010. With g = λ₋ − λ the (negated) change that a sweep
/// made and ρ = |g|²/|g₋|², a step λ += ρp follows each sweep but the last, with p = ρp − g; a
/// growing change (ρ > 1) drops p. Beside p its effect on the velocities M⁻¹Jᵀp is kept, so that a
/// step along it needs no pass over the Jacobians.

#include <Eigen/Core>
#include <algorithm>
#include <type_traits>
#include <vector>

#include "src2d/core/memory.h"
#include "src2d/dynamics/state.h"
#include "src2d/dynamics/wide_block.h"

namespace merge2d {

/// Impulses one after the other in memory, for which there are wide kernels (wide_block.h).
struct ImpulsesInARow {
  Impulses* first = nullptr;
  const WideKernels* kernels = nullptr;
  Impulses& operator()(std::size_t i) const { return first[i]; }
};

/// `impulses(i)` for i < `blocks` are those of a block of rows, `velocity(i)` for i < `bodies` what
/// they act on, each once; `sweep()` solves every block once and changes both. With `accelerate`
/// off: plain sweeps.
template <class ImpulsesAt, class VelocityAt, class Sweep>
class Nncg {
 public:
  Nncg(std::size_t blocks, ImpulsesAt impulses, std::size_t bodies, VelocityAt velocity,
       Sweep sweep, NncgBuffers& buffers)
      : blocks_(blocks),
        bodies_(bodies),
        impulses_(impulses),
        velocity_(velocity),
        sweep_(sweep),
        m_(buffers) {
    reserveTightly(m_.before, blocks);
    reserveTightly(m_.direction, blocks);
    reserveTightly(m_.u_before, bodies);
    reserveTightly(m_.u_direction, bodies);
    m_.before.resize(std::max(m_.before.size(), blocks));
    m_.u_before.resize(std::max(m_.u_before.size(), bodies));
    m_.direction.resize(m_.before.size());
    m_.u_direction.resize(m_.u_before.size());
  }

  /// Accelerated sweeps end where one changes the impulses by less than this part of them.
  void endBelow(double part) { least_ = part * part; }

  SweepChange run(int sweeps, bool accelerate) {
    return run(sweeps, accelerate, [] { return false; });
  }

  /// Accelerated sweeps that go on from the last ones, over the same blocks with the same buffers.
  template <class Enough>
  SweepChange resume(int sweeps, Enough&& enough) {
    const double squared = changeSince().squared;
    if (m_.previous == 0.0 || squared == 0.0) return run(sweeps, true, enough);
    step(squared / m_.previous);
    return iterate(sweeps, true, squared, enough);
  }

  /// The same, but for ending after a sweep upon which `enough()`.
  template <class Enough>
  SweepChange run(int sweeps, bool accelerate, Enough&& enough) {
    std::fill_n(m_.direction.begin(), blocks_, Impulses{});
    std::fill_n(m_.u_direction.begin(), bodies_, Twist{});
    if (accelerate) remember();
    return iterate(sweeps, accelerate, 0.0, enough);
  }

  int done() const { return done_; }  ///< sweeps of the last run

 private:
  static constexpr bool kInARow = std::is_same_v<ImpulsesAt, ImpulsesInARow>;

  template <class Enough>
  SweepChange iterate(int sweeps, bool accelerate, double previous, Enough&& enough) {
    SweepChange change;
    for (int k = 0; k < sweeps; ++k) {
      if (!accelerate) remember();
      sweep_();
      done_ = k + 1;
      const bool last = done_ == sweeps || enough();
      if (!accelerate && !last) continue;
      change = changeSince();
      m_.previous = previous;
      if (last || change.squared <= least_ * change.total) break;
      step(previous == 0.0 ? 0.0 : change.squared / previous);
      previous = change.squared;
    }
    return change;
  }

  void remember() {
    for (std::size_t i = 0; i < blocks_; ++i) m_.before[i] = impulses_(i);
    for (std::size_t i = 0; i < bodies_; ++i) {
      const SolverVelocity& u = velocity_(i);
      m_.u_before[i] = {u.vx, u.vy, u.omega};
    }
  }

  /// Four sums side by side, one per row of a block: always in the same order.
  SweepChange changeSince() const {
    if constexpr (kInARow) return impulses_.kernels->change(vectors());
    Eigen::Array4d squared = Eigen::Array4d::Zero(), total = squared;
    for (std::size_t i = 0; i < blocks_; ++i) {
      const Eigen::Array4d now = rows(impulses_(i)), change = now - rows(m_.before[i]);
      squared += change * change;
      total += now * now;
    }
    return {(squared[0] + squared[1]) + (squared[2] + squared[3]),
            (total[0] + total[1]) + (total[2] + total[3])};
  }

  /// The step along p; what it leaves is remembered for the next sweep.
  void step(double rho) {
    const double keep = rho > 1.0 ? 0.0 : 1.0;
    if (rho > 1.0) rho = 0.0;
    if constexpr (kInARow) impulses_.kernels->step(vectors(), rho, keep);
    for (std::size_t i = 0; !kInARow && i < blocks_; ++i) {
      auto lambda = rows(impulses_(i)), p = rows(m_.direction[i]), before = rows(m_.before[i]);
      const Eigen::Array4d along = rho * p, next = lambda + along;
      p = along + keep * (lambda - before);
      lambda = next;
      before = next;
    }
    for (std::size_t i = 0; i < bodies_; ++i) {
      SolverVelocity& u = velocity_(i);
      Twist &p = m_.u_direction[i], &before = m_.u_before[i];
      const Twist along{rho * p.vx, rho * p.vy, rho * p.omega};
      p = {along.vx + keep * (u.vx - before.vx), along.vy + keep * (u.vy - before.vy),
           along.omega + keep * (u.omega - before.omega)};
      before.vx = u.vx += along.vx;
      before.vy = u.vy += along.vy;
      before.omega = u.omega += along.omega;
    }
  }

  ImpulseVectors vectors() const {
    return {impulses_.first, m_.before.data(), m_.direction.data(), blocks_};
  }

  /// As one vector: a compiler alone takes them one by one where they may overlap.
  static Eigen::Map<Eigen::Array4d> rows(Impulses& x) {
    return Eigen::Map<Eigen::Array4d>(x.data());
  }

  std::size_t blocks_, bodies_;
  ImpulsesAt impulses_;
  VelocityAt velocity_;
  Sweep sweep_;
  NncgBuffers& m_;
  double least_ = 0.0;
  int done_ = 0;
};

}  // namespace merge2d
