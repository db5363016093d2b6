#include "src2d/merging/refine.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "src2d/dynamics/nncg.h"
#include "src2d/merging/disturbance.h"
#include "src2d/merging/interleave.h"
#include "src2d/merging/limits.h"

namespace merge2d {
namespace {

class Refinement {
 public:
  Refinement(State& state, Scratch& scratch, const SweepScope& scope, double threshold)
      : state_(state), scratch_(scratch), scope_(scope), threshold_(threshold) {
    chainLooseItems();
    place_ = nowhere();
    first_block_.reserve(state.collections.size());
    auto items = static_cast<std::uint32_t>(scope.loose.size());
    for (std::size_t slot = 0; slot < state.collections.size(); ++slot) {
      first_block_.push_back(items);
      if (scope.inside[slot])
        items += static_cast<std::uint32_t>(state.collections[slot].blocks.size());
    }
    swept_.resize(items);
    active_.reserve(items);
    inner_.reserve(items);
    reached_.reserve(scratch.sweep_u.size());
    walk_.resize(scratch.sweep_u.size() + 1);
  }

  double run(std::span<const std::uint32_t> seeds) {
    constexpr int kRound = 10;  // after so many sweeps the items are chosen anew
    queue_.assign(seeds.begin(), seeds.end());
    queueMarked(scratch_.restless_bodies);
    for (int done = 0; done < scope_.most && !queue_.empty();) {
      walk();
      const int more = std::max(1, std::min(kRound, scope_.most - done) - 1);
      converge(more);
      for (std::size_t i = 0; i < walked_; ++i) scratch_.shaken[walk_[i]] = 1;
      for (const auto& [c, block] : inner_) watchLimits(c->blocks[block], c->watches[block]);
      done += 1 + more;
      queueRestless();
    }
    return std::sqrt(std::max(left_, restless_));
  }

 private:
  static constexpr std::uint32_t kNowhere = Interleaving::kFixed;
  static constexpr int kMarked = 1;

  /// A body that the round at hand has reached.
  struct Reached {
    std::uint32_t body;
    double vx, vy;  ///< when the round began
    bool queued;    ///< all its items are swept
    bool loose;     ///< by a contact outside collections
  };

  /// Queues the bodies that the single sweep has marked, and takes the marks away.
  void queueMarked(std::vector<std::uint8_t>& marks) {
    std::uint8_t *const first = marks.data(), *const last = first + marks.size();
    const auto next = [&](std::uint8_t* from) {
      return static_cast<std::uint8_t*>(
          std::memchr(from, kMarked, static_cast<std::size_t>(last - from)));
    };
    for (std::uint8_t* at = next(first); at; at = next(at + 1)) {
      queue_.push_back(static_cast<std::uint32_t>(at - first));
      *at = 0;
    }
  }

  /// Per body, written as bytes, which is quickest.
  std::vector<std::uint32_t> nowhere() const {
    std::vector<std::uint32_t> places(scratch_.sweep_u.size());
    std::memset(places.data(), 0xff, places.size() * sizeof kNowhere);
    return places;
  }

  /// Each body's loose items as a chain, ascending.
  void chainLooseItems() {
    first_of_ = nowhere();
    next_of_.resize(2 * scope_.loose.size());
    for (auto i = static_cast<std::uint32_t>(scope_.loose.size()); i-- > 0;) {
      const SweepItem& item = scope_.loose[i];
      next_of_[2 * i] = std::exchange(first_of_[item.a()], 2 * i);
      next_of_[2 * i + 1] = std::exchange(first_of_[item.b()], 2 * i + 1);
    }
  }

  /// The place in reached_ of a body that responds to forces.
  std::uint32_t reach(std::uint32_t body) {
    if (place_[body] == kNowhere) {
      place_[body] = static_cast<std::uint32_t>(reached_.size());
      const SolverVelocity& u = scratch_.sweep_u[body];
      reached_.push_back({body, u.vx, u.vy, false, false});
    }
    return place_[body];
  }

  /// Queues a body where it `moves`, without a branch: the processor would have to predict it from
  /// a sweep that it has hardly begun, and be wrong half of the time.
  void enqueue(std::uint32_t place, bool moves = true) {
    Reached& r = reached_[place];
    const bool anew = moves & !r.queued;
    walk_[walked_] = r.body;
    walked_ += anew ? 1 : 0;
    r.queued |= anew;
  }

  /// One sweep from the queued bodies on, breadth first, over the items of each body that it
  /// changes by more than the threshold.
  void walk() {
    for (const Reached& r : reached_) place_[r.body] = kNowhere;
    reached_.clear();
    active_.clear();
    inner_.clear();
    walked_ = 0;
    std::ranges::fill(swept_, 0);
    for (const std::uint32_t body : queue_) {
      if (scratch_.sweep_u[body].inv_mass != 0.0) enqueue(reach(body));
    }
    walkFrom(0);
  }

  void walkFrom(std::size_t head) {
    for (; head < walked_; ++head) {
      sweepLooseItemsOf(walk_[head]);
      sweepInnerContactsOf(walk_[head]);
    }
  }

  /// True for a body at the rim of the walk that has changed, though its own items were not swept.
  bool isOvertaken(const Reached& r) const {
    const double parts = std::max(threshold_, state_.settings.unmerging.sliding);
    return !r.queued && r.loose && changeSinceStart(r) > parts * parts;
  }

  /// Goes on with the walk from such bodies. Returns false when there are none.
  bool goOnFromRim() {
    const std::size_t head = walked_;
    const auto count = static_cast<std::uint32_t>(reached_.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      if (isOvertaken(reached_[i])) enqueue(i);
    }
    walkFrom(head);
    return walked_ > head;
  }

  void sweepLooseItemsOf(std::uint32_t body) {
    for (std::uint32_t k = first_of_[body]; k != kNowhere; k = next_of_[k]) {
      if (!swept_[k / 2]) sweepOnce(k / 2, scope_.loose[k / 2]);
    }
  }

  void sweepInnerContactsOf(std::uint32_t body) {
    if (body >= state_.bodies.size()) return;  // the world
    const RigidId id = state_.bodies[body].rigid;
    if (!state_.isCollection(id)) return;
    const std::size_t slot = index(id) - state_.bodies.size();
    if (!scope_.inside[slot]) return;
    Collection& c = state_.collections[slot];
    const std::uint32_t member = state_[rigidOf(BodyId{body})].member;
    for (std::uint32_t k = c.weld_at[member]; k < c.weld_at[member + 1]; ++k) {
      const Weld& weld = c.welds[c.weld_of[k]];
      for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
        const std::uint32_t block = c.contacts[i].block, number = first_block_[slot] + block;
        if (swept_[number]) continue;
        sweepOnce(number, SweepItem(c.blocks[block], state_[id].rotation));
        inner_.emplace_back(&c, block);
      }
    }
  }

  void sweepOnce(std::uint32_t number, const SweepItem& item) {
    swept_[number] = 1;
    active_.push_back(item);
    const bool loose = number < scope_.loose.size();
    std::uint32_t places[2], count = 0;
    for (const std::uint32_t b : {item.a(), item.b()}) {
      if (scratch_.sweep_u[b].inv_mass == 0.0) continue;
      reached_[places[count++] = reach(b)].loose |= loose;
    }
    sweepItem(item, scratch_.sweep_u, state_.settings.solver.method);
    for (const std::uint32_t place : std::span(places, count)) {
      enqueue(place, changeSinceStart(reached_[place]) > threshold_ * threshold_);
    }
  }

  /// Squared [m²/s²].
  double changeSinceStart(const Reached& r) const {
    const SolverVelocity& u = scratch_.sweep_u[r.body];
    return square(u.vx - r.vx) + square(u.vy - r.vy);
  }
  double changeInLastSweep(std::size_t i) const {  // of the conjugate gradient's own memory
    const SolverVelocity& u = scratch_.sweep_u[reached_[i].body];
    const Twist& last = scratch_.nncg.u_before[i];
    return square(u.vx - last.vx) + square(u.vy - last.vy);
  }
  static double square(double x) { return x * x; }

  /// Sweeps the items of the walk, and extends the walk where bodies at its rim are overtaken. The
  /// sweep that found these is not counted, or a blow would end at a gap that it closes late.
  void converge(int sweeps) {
    auto& u = scratch_.sweep_u;
    const SolverMethod method = state_.settings.solver.method;
    const auto overtaken = [&] {
      return std::ranges::any_of(reached_, [&](const Reached& r) { return isOvertaken(r); });
    };
    int most = 2 * sweeps;
    for (int done = 0; done < sweeps && most > 0;) {
      const auto items = interleaving_.of(active_, reached_.size(),
                                          [&](std::uint32_t body) { return place_[body]; });
      Nncg iteration(
          active_.size(), [&](std::size_t i) -> Impulses& { return active_[i].impulses(); },
          reached_.size(), [&](std::size_t i) -> SolverVelocity& { return u[reached_[i].body]; },
          [&] {
            for (const SweepItem& item : items) sweepItem(item, u, method);
          },
          scratch_.nncg);
      known_ = reached_.size();
      iteration.run(std::min(sweeps - done, most), isAccelerated(method), overtaken);
      most -= iteration.done();
      done += iteration.done();
      if (!goOnFromRim()) break;
      --done;
    }
  }

  /// Queues the bodies that are not quiet: those that the last sweep still changed, and at the rim,
  /// where not all items know of it yet, those that moved in this round. Notes jolts.
  void queueRestless() {
    queue_.clear();
    restless_ = 0.0;
    for (std::size_t i = 0; i < reached_.size(); ++i) {
      const bool swept = reached_[i].queued && i < known_;
      const double since_start = changeSinceStart(reached_[i]);
      noteJolt(state_, reached_[i].body, since_start);
      const double change = swept ? changeInLastSweep(i) : since_start;
      const bool restless = change > threshold_ * threshold_;
      if (restless) queue_.push_back(reached_[i].body);
      double& largest = restless ? restless_ : left_;
      largest = std::max(largest, change);
    }
  }

  State& state_;
  Scratch& scratch_;
  const SweepScope& scope_;
  double threshold_;
  /// Chains of the loose items' ends, 2i and 2i + 1 of item i: per body the first, per end the
  /// next.
  std::vector<std::uint32_t> first_of_, next_of_;
  std::vector<std::uint32_t> first_block_;  ///< per collection slot: number of its first block
  std::vector<std::uint8_t> swept_;         ///< in this round, by number: loose items, then blocks
  std::vector<std::uint32_t> place_;        ///< per body: in reached_
  std::vector<std::uint32_t> queue_;        ///< bodies from which a round begins
  std::vector<std::uint32_t> walk_;         ///< bodies whose items are swept in this round, first
  std::size_t walked_ = 0;                  ///< so many
  std::vector<Reached> reached_;            ///< by this round; only those that respond to forces
  std::size_t known_ = 0;                   ///< so many of them when the last sweeps began
  std::vector<SweepItem> active_;           ///< of this round, in the order of the walk
  Interleaving interleaving_;               ///< of them, for the sweeps after the walk
  std::vector<std::pair<Collection*, std::uint32_t>> inner_;  ///< blocks among them

  // Largest changes of a body's velocity, squared [m²/s²].
  double restless_ = 0.0;  ///< in the last sweep
  double left_ = 0.0;      ///< of bodies that were left alone after it
};

}  // namespace

double residualVelocity(const State& state) {
  constexpr double kPart = 1e-3;
  return std::max(kPart * state.h * state.gravity.norm(), state.settings.sleeping.velocity);
}

double refinedVelocity(const State& state) {
  constexpr double kPart = 0.1;
  return kPart * state.settings.unmerging.sliding;
}

double sweepUntilQuiet(State& state, Scratch& scratch, const SweepScope& scope,
                       std::span<const std::uint32_t> seeds, double threshold) {
  return Refinement(state, scratch, scope, threshold).run(seeds);
}

}  // namespace merge2d
