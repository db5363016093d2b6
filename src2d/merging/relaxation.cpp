#include "src2d/merging/relaxation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "src2d/dynamics/joint_system.h"
#include "src2d/dynamics/nncg.h"
#include "src2d/dynamics/wide_blocks.h"
#include "src2d/merging/decided_settings.h"

namespace merge2d {
namespace {

/// A few rounds over the rows with a residual and those beside them, as most disturbances are
/// local; then sweeps over all rows.
class Relaxation {
 public:
  Relaxation(const State& state, Scratch& scratch, Collection& c, double tolerance)
      : state_(state),
        u_(scratch.trial_u),
        scratch_(scratch),
        c_(c),
        tolerance_(tolerance),
        left_(std::max(kDecided.row_sweeps,
                       kDecided.full_sweeps * static_cast<double>(c.blocks.size()))) {
    if (isSearch()) {
      left_ = std::min(left_, std::ldexp(kDecided.first_row_sweeps, search().steps));
    }
    if (!isSearch() && !isHit(state, c)) left_ *= kDecided.when_open;
    for (const ContactBlock& k : c.blocks) ends_.push_back({memberOf(k.a), memberOf(k.b)});
    all_.resize(c.blocks.size());
    std::iota(all_.begin(), all_.end(), 0u);
  }

  double run() { return isLocal() ? runLocally() : runWidely(); }

 private:
  double runWidely() {
    bool whole = isUnderWay();
    if (whole) sweepAll(affordable(c_.blocks.size()));
    double residual = choose();
    for (int round = 0; mayGoOn() && !(whole && residual <= tolerance_); ++round) {
      const bool quiet = residual <= tolerance_;  // but rows just below it can move as a whole
      whole |= quiet || round == kLocalRounds || 2 * blocks_.size() >= c_.blocks.size();
      if (!whole) {
        sweep(kRound);
      } else {
        sweepAll(quiet ? kLookEvery : affordable(c_.blocks.size()));
      }
      residual = choose();
    }
    return residual;
  }

  /// A hit is followed as far as it moves anything: after each round only the rows are looked at
  /// that it may have changed.
  double runLocally() {
    double residual = choose();
    left_ =
        std::max(kDecided.row_sweeps, kDecided.full_sweeps * static_cast<double>(blocks_.size()));
    listBlocksAtMembers();
    while (residual > tolerance_ && mayGoOn()) {
      sweep(kRound);
      residual = chooseBeside();
    }
    return residual;
  }
  bool isLocal() { return !isSearch() && isHit(state_, c_) && isLarge(c_); }

  static constexpr int kRound = 10, kLookEvery = 5;  // sweeps
  static constexpr int kLocalRounds = 3;
  static constexpr std::size_t kLeastWide = 8;  // blocks
  static constexpr std::uint32_t kFrame = ~0u;

  std::uint32_t memberOf(std::uint32_t body) const {
    if (body >= state_.bodies.size() || state_.bodies[body].rigid != c_.rigid) return kFrame;
    return state_.rigids[body].member;
  }

  double residualOfBlock(std::uint32_t i) const {
    const ContactBlock& k = c_.blocks[i];
    return residualOf(k, k.nx, k.ny, u_[k.a], u_[k.b]);
  }

  /// Chooses the rows at members at which some row has a residual; returns the largest [m/s].
  double choose() {
    double most = 0.0;
    hot_.assign(c_.members.size(), 0);
    for (std::uint32_t i = 0; i < c_.blocks.size(); ++i) {
      const double residual = residualOfBlock(i);
      most = std::max(most, residual);
      if (residual <= tolerance_) continue;
      for (const std::uint32_t m : ends_[i]) {
        if (m != kFrame) hot_[m] = 1;
      }
    }
    take(all_, [&](std::uint32_t i) {
      return std::ranges::any_of(ends_[i], [&](auto m) { return m != kFrame && hot_[m]; });
    });
    return most;
  }

  void listBlocksAtMembers() {
    first_.assign(c_.members.size() + 2, 0);
    const auto forEachEnd = [&](auto&& visit) {
      for (std::uint32_t i = 0; i < ends_.size(); ++i) {
        for (const std::uint32_t m : ends_[i]) {
          if (m != kFrame) visit(m, i);
        }
      }
    };
    forEachEnd([&](std::uint32_t m, std::uint32_t) { ++first_[m + 2]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    at_.resize(first_.back());
    forEachEnd([&](std::uint32_t m, std::uint32_t i) { at_[first_[m + 1]++] = i; });
  }

  /// Ascending.
  std::vector<std::uint32_t> blocksAt(const std::vector<std::uint32_t>& members) {
    constexpr std::uint32_t kBits = 64;
    marks_.resize(c_.blocks.size() / kBits + 1, 0);
    for (const std::uint32_t m : members) {
      for (std::uint32_t i = first_[m]; i < first_[m + 1]; ++i) {
        marks_[at_[i] / kBits] |= std::uint64_t{1} << at_[i] % kBits;
      }
    }
    std::vector<std::uint32_t> blocks;
    for (std::uint32_t word = 0; word < marks_.size(); ++word) {
      for (; marks_[word] != 0; marks_[word] &= marks_[word] - 1) {
        blocks.push_back(kBits * word + static_cast<std::uint32_t>(std::countr_zero(marks_[word])));
      }
    }
    return blocks;
  }

  /// The same as `choose` where nothing has changed but at the members that were swept.
  double chooseBeside() {
    double most = 0.0;
    std::vector<std::uint32_t> hot;
    for (const std::uint32_t i : blocksAt(members_)) {
      const double residual = residualOfBlock(i);
      most = std::max(most, residual);
      if (residual <= tolerance_) continue;
      for (const std::uint32_t m : ends_[i]) {
        if (m != kFrame) hot.push_back(m);
      }
    }
    take(blocksAt(hot), [](std::uint32_t) { return true; });
    return most;
  }

  /// The blocks to be swept, and their members.
  template <class Wanted>
  void take(const std::vector<std::uint32_t>& of, Wanted&& wanted) {
    blocks_.clear();
    members_.clear();
    taken_.assign(c_.members.size(), 0);
    for (const std::uint32_t i : of) {
      if (!wanted(i)) continue;
      blocks_.push_back(i);
      for (const std::uint32_t m : ends_[i]) {
        if (m == kFrame || taken_[m]) continue;
        taken_[m] = 1;
        members_.push_back(m);
      }
    }
  }

  void sweepAll(int most) {
    take(all_, [](std::uint32_t) { return true; });
    sweep(most);
  }

  void sweep(int most) {
    if (c_.joints.empty() && blocks_.size() >= kLeastWide &&
        scratch_.sweep_path != SweepPath::OneByOne) {
      sweepWide(most);
    } else {
      sweepOneByOne(most);
    }
    settleJoints(c_, {}, u_, tolerance_);
  }

  void sweepOneByOne(int most) {
    run(
        most, [&](std::size_t i) -> Impulses& { return c_.blocks[blocks_[i]].lambda; },
        [&] {
          for (JointBlock& k : c_.joints) solveJoint(k, {}, u_[k.a], u_[k.b]);
          for (const std::uint32_t i : blocks_) {
            ContactBlock& k = c_.blocks[i];
            solveBlock(k, k.nx, k.ny, u_[k.a], u_[k.b]);
          }
        },
        [] {});
  }

  void sweepWide(int most) {
    WideBlocks& wide = scratch_.wide;
    u_.back() = {};
    wide.packChosen(c_.blocks, blocks_, u_, static_cast<std::uint32_t>(u_.size() - 1));
    const auto store = [&] { wide.storeImpulses(c_.blocks); };
    run(
        most, [&](std::size_t i) -> Impulses& { return wide.impulses()[blocks_[i]]; },
        [&] { wide.sweep(c_.blocks, u_, scratch_.sweep_path); }, store);
    store();
  }

  /// `store` writes the impulses into the blocks.
  template <class ImpulsesAt, class Sweep, class Store>
  void run(int most, ImpulsesAt impulses, Sweep sweep, Store store) {
    Nncg iteration(
        blocks_.size(), impulses, members_.size(),
        [&](std::size_t i) -> SolverVelocity& { return u_[index(c_.members[members_[i]])]; }, sweep,
        buffers());
    int done = 0;
    const auto enough = [&] {
      if (++done % kLookEvery != 0) return false;
      store();
      return isQuiet();
    };
    if (isUnderWay()) {
      iteration.resume(most, enough);
    } else {
      iteration.run(most, c_.joints.empty(), enough);
    }
    sweeps_ += iteration.done();
    left_ -= iteration.done() * static_cast<double>(blocks_.size());
  }

  bool isQuiet() const {
    return std::ranges::all_of(blocks_,
                               [&](std::uint32_t i) { return residualOfBlock(i) <= tolerance_; });
  }

  /// Sweeps over all rows of a search are continued in the next step.
  NncgBuffers& buffers() {
    const bool all = blocks_.size() == c_.blocks.size();
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

  const State& state_;
  std::vector<SolverVelocity>& u_;
  Scratch& scratch_;
  Collection& c_;
  double tolerance_;
  double left_;  ///< row sweeps that may still be spent
  int sweeps_ = 0;
  std::vector<std::array<std::uint32_t, 2>> ends_;  ///< per block: its members, or the frame
  std::vector<std::uint32_t> all_;                  ///< blocks
  std::vector<std::uint32_t> blocks_, members_;     ///< that are swept
  std::vector<std::uint8_t> hot_, taken_;           ///< per member
  std::vector<std::uint32_t> first_, at_;           ///< per member: its run of blocks
  std::vector<std::uint64_t> marks_;                ///< per block, as bits
};

}  // namespace

double residualInside(const Collection& c, const std::vector<SolverVelocity>& u) {
  double most = 0.0;
  for (const ContactBlock& k : c.blocks) {
    most = std::max(most, residualOf(k, k.nx, k.ny, u[k.a], u[k.b]));
  }
  return most;
}

double relax(const State& state, Scratch& scratch, Collection& c, double tolerance) {
  return Relaxation(state, scratch, c, tolerance).run();
}

}  // namespace merge2d
