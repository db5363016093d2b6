#pragma once
/// The sweeps that a step may spend on the rows inside one collection.

#include <algorithm>
#include <cmath>

#include "src2d/proofs/decided_settings.h"
#include "src2d/relaxation/reached_rows.h"

namespace merge2d {

/// How many sweeps a solve inside a collection may still spend in this step, over any number of
/// rows.
class SweepBudget {
 public:
  /// As much as a step may spend over so many rows.
  static SweepBudget ofStep(const State& state, std::size_t rows) {
    return SweepBudget(rowSweeps(state, rows));
  }
  /// A search begins with 500 row sweeps, one round over 50 rows, and doubles them in each step, as
  /// many loads do not last: the collapsing tower-platform then takes half as many.
  static SweepBudget ofSearch(const State& state, std::size_t rows, int step) {
    const double first = ReachedRows::kRound * kDecided.row_sweeps / kDecided.patience;
    return SweepBudget(std::min(rowSweeps(state, rows), std::ldexp(first, step)));
  }
  /// More where motion was found, as the end decides which welds part.
  static SweepBudget ofOpened(const State& state, std::size_t rows) {
    return SweepBudget(kDecided.when_open * rowSweeps(state, rows));
  }

  bool isSpent() const { return sweeps_ >= kDecided.patience || left_ <= 0.0; }
  bool isUntouched() const { return sweeps_ == 0; }

  /// Sweeps over so many rows that are left, at least one.
  int affordable(std::size_t rows) const {
    const double sweeps = left_ / static_cast<double>(std::max<std::size_t>(rows, 1));
    return std::clamp(static_cast<int>(sweeps), 1, std::max(1, kDecided.patience - sweeps_));
  }

  void spend(int sweeps, std::size_t rows) {
    sweeps_ += sweeps;
    left_ -= sweeps * static_cast<double>(rows);
  }

 private:
  explicit SweepBudget(double rows) : left_(rows) {}

  double left_;  ///< row sweeps
  int sweeps_ = 0;
};

}  // namespace merge2d
