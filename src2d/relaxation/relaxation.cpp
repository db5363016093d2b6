#include "src2d/relaxation/relaxation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src2d/collections/collection.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/relaxation/block_sweeps.h"
#include "src2d/relaxation/reached_rows.h"

namespace merge2d {
namespace {

/// Sweeps over the rows that a residual reaches, as most disturbances are local; once none of these
/// has one, or they are half of all, over all rows.
class Relaxation {
 public:
  Relaxation(const State& state, Scratch& scratch, Collection& c, double tolerance)
      : scratch_(scratch),
        c_(c),
        sweeps_of_(scratch, c, tolerance),
        reached_(sweeps_of_, c, [](std::uint32_t) {}),
        large_(isLarge(state, c)),
        left_(rowSweeps(state, c.blocks.size())) {
    if (isSearch()) {
      left_ = std::min(left_, std::ldexp(kDecided.first_row_sweeps, search().steps));
    }
    if (!isSearch() && !isHit(state, c)) left_ *= kDecided.when_open;
    listWeldsOfMembers(c);
    all_.resize(c.blocks.size());
    std::iota(all_.begin(), all_.end(), 0u);
  }

  double run() {
    if (whole_) sweepAll(affordable(c_.blocks.size()));
    double residual = reached_.look(all_);
    while (mayGoOn() && !hasEnded(residual)) {
      const bool quiet = residual <= sweeps_of_.tolerance;
      whole_ |= quiet || 2 * reached_.blocks().size() >= c_.blocks.size();
      if (whole_) {
        sweepAll(quiet ? BlockSweeps::kLookEvery : affordable(c_.blocks.size()));
        residual = sweeps_of_.largestResidual();
      } else {
        sweep(ReachedRows::kRound, reached_.blocks(), reached_.bodies());
        residual = reached_.lookAgain();
      }
    }
    return residual;
  }

 private:
  /// Rows just below the tolerance may still move as a whole: where none had a residual from the
  /// start, or to look is cheap, all of them are swept once more.
  bool hasEnded(double residual) const {
    const bool local = large_ && !reached_.blocks().empty();
    return residual <= sweeps_of_.tolerance && (whole_ || local);
  }

  void sweepAll(int most) { sweep(most, all_, c_.members); }

  void sweep(int most, std::span<const std::uint32_t> blocks, std::span<const BodyId> bodies) {
    // Those over all rows of a search are continued in the next step.
    NncgBuffers& buffers = isSearch() && whole_ ? search().nncg : scratch_.nncg;
    const int done = sweeps_of_.run(most, blocks, bodies, buffers, isUnderWay());
    sweeps_ += done;
    left_ -= done * static_cast<double>(blocks.size());
  }

  ProofSearch& search() { return c_.certificate.front().search; }
  bool isSearch() { return search().isUnderWay(); }
  /// Sweeps over all rows that go on.
  bool isUnderWay() { return isSearch() && search().isInAllRows(); }

  bool mayGoOn() const { return sweeps_ == 0 || (sweeps_ < kDecided.most_sweeps && left_ > 0.0); }
  /// Sweeps over so many rows that this step can still spend.
  int affordable(std::size_t rows) const {
    const double sweeps = left_ / static_cast<double>(std::max<std::size_t>(rows, 1));
    return std::clamp(static_cast<int>(sweeps), 1, std::max(1, kDecided.most_sweeps - sweeps_));
  }

  Scratch& scratch_;
  Collection& c_;
  BlockSweeps sweeps_of_;
  ReachedRows reached_;
  bool whole_ = isUnderWay();  ///< all rows are swept
  bool large_;
  double left_;  ///< row sweeps that may still be spent
  int sweeps_ = 0;
  std::vector<std::uint32_t> all_;  ///< blocks
};

}  // namespace

double relax(const State& state, Scratch& scratch, Collection& c, double tolerance) {
  return Relaxation(state, scratch, c, tolerance).run();
}

}  // namespace merge2d
