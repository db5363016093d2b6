#include "src2d/relaxation/relaxation.h"

#include <numeric>

#include "src2d/collections/collection.h"
#include "src2d/relaxation/block_sweeps.h"
#include "src2d/relaxation/reached_rows.h"

namespace merge2d {
namespace {

/// Sweeps over the rows that a residual reaches, as most disturbances are local; once none of these
/// has one, or they are half of all, over all rows.
class Relaxation {
 public:
  Relaxation(const SweepTools& tools, Collection& c, double tolerance, bool large,
             SweepBudget budget, ProofSearch* search)
      : memory_(tools.memory),
        c_(c),
        sweeps_of_(tools, c, tolerance),
        reached_(sweeps_of_, c, [](std::uint32_t) {}),
        large_(large),
        budget_(budget),
        search_(search) {
    listWeldsOfMembers(c);
    all_.resize(c.blocks.size());
    std::iota(all_.begin(), all_.end(), 0u);
  }

  double run() {
    if (whole_) sweepAll(budget_.affordable(c_.blocks.size()));
    double residual = reached_.look(all_);
    while ((budget_.isUntouched() || !budget_.isSpent()) && !hasEnded(residual)) {
      const bool quiet = residual <= sweeps_of_.tolerance;
      whole_ |= quiet || 2 * reached_.blocks().size() >= c_.blocks.size();
      if (whole_) {
        sweepAll(quiet ? BlockSweeps::kLookEvery : budget_.affordable(c_.blocks.size()));
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
    NncgBuffers& buffers = search_ && whole_ ? search_->nncg : memory_.nncg;
    const int done = sweeps_of_.run(most, blocks, bodies, buffers, goesOn());
    budget_.spend(done, blocks.size());
  }

  /// Sweeps over all rows are under way.
  bool goesOn() const { return search_ && search_->isInAllRows(); }

  SweepMemory& memory_;
  Collection& c_;
  BlockSweeps sweeps_of_;
  ReachedRows reached_;
  bool large_;
  SweepBudget budget_;
  ProofSearch* search_;
  bool whole_ = goesOn();           ///< all rows are swept
  std::vector<std::uint32_t> all_;  ///< blocks
};

}  // namespace

double relax(const State& state, const SweepTools& tools, Collection& c, double tolerance,
             SweepBudget budget, ProofSearch* search) {
  c.push.forget();
  return Relaxation(tools, c, tolerance, isLarge(state, c), budget, search).run();
}

}  // namespace merge2d
