#include "src2d/relaxation/relaxation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src2d/proofs/decided_settings.h"
#include "src2d/relaxation/block_sweeps.h"

namespace merge2d {
namespace {

/// A few rounds over the rows with a residual and those beside them, as most disturbances are
/// local; then sweeps over all rows.
class Relaxation {
 public:
  Relaxation(const State& state, Scratch& scratch, Collection& c, double tolerance)
      : scratch_(scratch),
        c_(c),
        sweeps_of_(scratch, c, tolerance),
        tolerance_(tolerance),
        left_(rowSweeps(state, c.blocks.size())) {
    if (isSearch()) {
      left_ = std::min(left_, std::ldexp(kDecided.first_row_sweeps, search().steps));
    }
    if (!isSearch() && !isHit(state, c)) left_ *= kDecided.when_open;
    all_.resize(c.blocks.size());
    std::iota(all_.begin(), all_.end(), 0u);
  }

  double run() {
    constexpr int kRound = 10, kLocalRounds = 3;  // sweeps, and rounds of them
    bool whole = isUnderWay();
    if (whole) sweepAll(affordable(c_.blocks.size()));
    double residual = choose();
    for (int round = 0; mayGoOn() && !(whole && residual <= tolerance_); ++round) {
      const bool quiet = residual <= tolerance_;  // but rows just below it can move as a whole
      whole |= quiet || round == kLocalRounds || 2 * blocks_.size() >= c_.blocks.size();
      if (!whole) {
        sweep(kRound, blocks_, bodies_);
      } else {
        sweepAll(quiet ? BlockSweeps::kLookEvery : affordable(c_.blocks.size()));
      }
      residual = choose();
    }
    return residual;
  }

 private:
  /// The members of a block, or the frame.
  std::array<std::uint32_t, 2> endsOf(std::uint32_t block) const {
    const Weld& weld = c_.welds[c_.contacts[c_.block_contact[block]].weld];
    return {weld.node_a, weld.node_b};
  }

  /// Chooses the rows at members at which some row has a residual; returns the largest [m/s].
  double choose() {
    double most = 0.0;
    const auto frame = static_cast<std::uint32_t>(c_.members.size());
    hot_.assign(frame + 1, 0);
    bool any = false;
    for (const std::uint32_t i : all_) {
      const double residual = sweeps_of_.residual(i);
      most = std::max(most, residual);
      if (residual <= tolerance_) continue;
      for (const std::uint32_t m : endsOf(i)) hot_[m] = any = true;
    }
    hot_[frame] = 0;
    blocks_.clear();
    bodies_.clear();
    if (!any) return most;
    std::vector<std::uint8_t> taken(frame + 1, 0);
    taken[frame] = 1;
    for (const std::uint32_t i : all_) {
      const auto ends = endsOf(i);
      if (!hot_[ends[0]] && !hot_[ends[1]]) continue;
      blocks_.push_back(i);
      for (const std::uint32_t m : ends) {
        if (!std::exchange(taken[m], 1)) bodies_.push_back(c_.members[m]);
      }
    }
    return most;
  }

  void sweepAll(int most) { sweep(most, all_, c_.members); }

  void sweep(int most, std::span<const std::uint32_t> blocks, std::span<const BodyId> bodies) {
    const int done = sweeps_of_.run(most, blocks, bodies, buffersFor(blocks), isUnderWay());
    sweeps_ += done;
    left_ -= done * static_cast<double>(blocks.size());
  }

  /// Sweeps over all rows of a search are continued in the next step.
  NncgBuffers& buffersFor(std::span<const std::uint32_t> blocks) {
    const bool all = blocks.size() == c_.blocks.size();
    return isSearch() && all ? search().nncg : scratch_.nncg;
  }
  ProofSearch& search() { return c_.certificate.front().search; }
  bool isSearch() { return !search().start.empty(); }
  bool isUnderWay() { return isSearch() && search().nncg.previous > 0.0; }

  bool mayGoOn() const { return sweeps_ == 0 || (sweeps_ < kDecided.most_sweeps && left_ > 0.0); }
  /// Sweeps over so many rows that this step can still spend.
  int affordable(std::size_t rows) const {
    const double sweeps = left_ / static_cast<double>(std::max<std::size_t>(rows, 1));
    return std::clamp(static_cast<int>(sweeps), 1, std::max(1, kDecided.most_sweeps - sweeps_));
  }

  Scratch& scratch_;
  Collection& c_;
  BlockSweeps sweeps_of_;
  double tolerance_;
  double left_;  ///< row sweeps that may still be spent
  int sweeps_ = 0;
  std::vector<std::uint32_t> all_;     ///< blocks
  std::vector<std::uint32_t> blocks_;  ///< that are swept
  std::vector<BodyId> bodies_;         ///< at them
  std::vector<std::uint8_t> hot_;      ///< per member
};

}  // namespace

double relax(const State& state, Scratch& scratch, Collection& c, double tolerance) {
  return Relaxation(state, scratch, c, tolerance).run();
}

}  // namespace merge2d
