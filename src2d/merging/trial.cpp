#include "src2d/merging/trial.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "src2d/dynamics/nncg.h"
#include "src2d/merging/caution.h"
#include "src2d/merging/disturbance.h"
#include "src2d/merging/grip.h"
#include "src2d/merging/momentum.h"
#include "src2d/merging/refine.h"
#include "src2d/merging/spare_welds.h"

namespace merge2d {
namespace {

std::uint32_t largestOf(const Parts& parts) {
  std::vector<std::size_t> size(parts.anchored.size(), 0);
  for (const std::uint32_t p : parts.part) ++size[p];
  return static_cast<std::uint32_t>(std::ranges::max_element(size) - size.begin());
}

/// The largest sum of evidence against a weld; none where a single step was enough.
Drift evidenceOf(const Collection& c, const Weld& weld) {
  if (weld.reason == EventReason::RelativeMotion) {
    return {weld.turning.sum, std::max(1, weld.turning.steps)};
  }
  Drift most{0.0F, 1};
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    for (const PointWatch& point : c.contacts[i].watch) {
      const Drift& drift = weld.reason == EventReason::Sliding ? point.slip : point.opening;
      if (drift.steps >= most.steps) most = drift;
    }
  }
  return most;
}

/// The evidence against the welds of a part.
struct Evidence {
  int steps = 0;         ///< over which it was summed; 0: no weld of it was cut
  double sum = 0.0;      ///< the largest [m/s]
  double caution = 1.0;  ///< the least factor

  void add(const Drift& drift, double factor) {
    caution = steps == 0 ? factor : std::min(caution, factor);
    steps = std::max(steps, drift.steps);
    sum = std::max(sum, std::abs<double>(drift.sum));
  }
};

/// One proposal in the trial.
struct Tried {
  Collection* c;
  const Parts* parts;
  std::uint32_t host;                 ///< the largest part
  bool fits;                          ///< fewer than half move, and the host stays anchored or not
  std::vector<Evidence> against;      ///< per part
  std::vector<std::uint8_t> moves{};  ///< per part: the result

  /// The host moves too where the proposal does not fit.
  bool isMover(std::uint32_t part) const { return part != host || !fits; }
};

/// Solves the contacts of all parts that could move as if they were free.
class Trial {
 public:
  Trial(State& state, Scratch& scratch, std::span<const Proposal> proposals)
      : state_(state),
        scratch_(scratch),
        of_slot_(state.collections.size(), kNone),
        place_(scratch.sweep_u.size(), kNone) {
    for (const Proposal& proposal : proposals) {
      of_slot_[index(proposal.rigid) - state.bodies.size()] =
          static_cast<std::uint32_t>(tried_.size());
      tried_.push_back(enter(proposal));
    }
  }

  /// Solves, and marks the parts that move.
  std::vector<Tried> run() {
    if (std::ranges::none_of(tried_, &Tried::fits)) return tried_;
    list();
    remember();
    freeze();
    solve();
    for (Tried& t : tried_) {
      if (t.fits) judgeParts(t);
    }
    restore();
    return tried_;
  }

 private:
  static constexpr std::uint32_t kNone = ~0u;

  Tried enter(const Proposal& proposal) const {
    const Parts& parts = proposal.parts;
    const std::uint32_t host = largestOf(parts);
    const auto movers = static_cast<std::size_t>(
        std::ranges::count_if(parts.part, [&](std::uint32_t p) { return p != host; }));
    const bool anchored = parts.anchored[host] != 0;
    const bool fits = !proposal.sure && anchored != state_[proposal.rigid].floating() &&
                      movers > 0 && 2 * movers < parts.part.size();
    return {&state_.collection(proposal.rigid), &parts, host, fits,
            std::vector<Evidence>(parts.anchored.size())};
  }

  bool isMover(std::uint32_t body) const {
    if (body >= state_.bodies.size()) return false;  // the world
    const RigidId id = state_.bodies[body].rigid;
    if (!state_.isCollection(id)) return false;
    const std::uint32_t t = of_slot_[index(id) - state_.bodies.size()];
    if (t == kNone) return false;
    return tried_[t].isMover(tried_[t].parts->part[state_[rigidOf(BodyId{body})].member]);
  }

  /// Lists the contacts and joints at the movers.
  void list() {
    for (Tried& t : tried_) listInside(t);
    for (SweepContact& outer : scratch_.sweep_contacts) {
      if (isMover(outer.block.a) || isMover(outer.block.b)) {
        items_.emplace_back(outer.block);
      }
    }
    for (JointBlock& k : scratch_.sweep_joints) {
      if (isMover(k.a) || isMover(k.b)) items_.emplace_back(k);
    }
  }

  /// The same in one collection, and the evidence against each part.
  void listInside(Tried& t) {
    Collection& c = *t.c;
    const Rotation turn = state_[c.rigid].rotation;
    const auto frame = static_cast<std::uint32_t>(t.against.size());
    const auto partOf = [&](std::uint32_t node) {
      return node < t.parts->part.size() ? t.parts->part[node] : frame;
    };
    const auto moves = [&](std::uint32_t part) { return part != frame && t.isMover(part); };
    for (const Weld& weld : c.welds) {
      const std::uint32_t p = partOf(weld.node_a), q = partOf(weld.node_b);
      if (!moves(p) && !moves(q)) continue;
      for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
        items_.emplace_back(c.blocks[c.contacts[i].block], turn);
      }
      if (!weld.cut) continue;
      for (const std::uint32_t part : {p, q}) {
        if (part != frame) t.against[part].add(evidenceOf(c, weld), cautionWith(state_, c, weld));
      }
    }
    for (JointBlock& k : c.joints) {
      if (isMover(k.a) || isMover(k.b)) items_.emplace_back(k, turn);
    }
  }

  void remember() {
    for (const SweepItem& item : items_) {
      impulses_.push_back(item.impulses());
      for (const std::uint32_t b : {item.a(), item.b()}) {
        if (place_[b] != kNone) continue;
        place_[b] = static_cast<std::uint32_t>(touched_.size());
        touched_.push_back(b);
        velocities_.push_back(scratch_.sweep_u[b]);
      }
    }
  }

  void restore() {
    for (std::size_t i = 0; i < items_.size(); ++i) items_[i].impulses() = impulses_[i];
    for (std::size_t i = 0; i < touched_.size(); ++i)
      scratch_.sweep_u[touched_[i]] = velocities_[i];
  }

  /// A body that stays in its collection gets the collection's velocity, and does not respond.
  void freeze() {
    for (const std::uint32_t b : touched_) {
      if (b >= state_.bodies.size() || isMover(b)) continue;
      const RigidId id = state_.bodies[b].rigid;
      if (!state_.isCollection(id)) continue;
      const VelocityField field = fieldOf(id);
      const Vec2 v = field.at(state_.pose(BodyId{b}).position);
      scratch_.sweep_u[b] = {v.x(), v.y(), field.omega, 0.0, 0.0};
    }
  }

  /// Of a body before the trial.
  const SolverVelocity& velocityBefore(BodyId b) const {
    const std::uint32_t place = place_[index(b)];
    return place == kNone ? scratch_.sweep_u[index(b)] : velocities_[place];
  }

  /// How a collection moves at the end of this step, as the sweep has left it.
  VelocityField fieldOf(RigidId id) {
    const auto known = std::ranges::find(fields_, id, &Known::id);
    if (known != fields_.end()) return known->field;
    const VelocityField field =
        merge2d::fieldOf(state_, state_.collection(id),
                         [&](BodyId b) -> const SolverVelocity& { return velocityBefore(b); });
    fields_.push_back({id, field});
    return field;
  }

  void solve() {
    auto& u = scratch_.sweep_u;
    std::erase_if(bodies_ = touched_, [&](std::uint32_t b) { return u[b].inv_mass == 0.0; });
    const SolverMethod method = state_.settings.solver.method;
    Nncg iteration(
        items_.size(), [&](std::size_t i) -> Impulses& { return items_[i].impulses(); },
        bodies_.size(), [&](std::size_t i) -> SolverVelocity& { return u[bodies_[i]]; },
        [&] {
          for (const SweepItem& item : items_) sweepItem(item, u, method);
        },
        scratch_.nncg);
    const int most =
        std::max(state_.settings.unmerging.disturbed_sweeps, state_.settings.solver.iterations);
    iteration.run(most, isAccelerated(method));
  }

  void judgeParts(Tried& t) {
    t.moves.assign(t.against.size(), 0);
    for (std::uint32_t m = 0; m < t.parts->part.size(); ++m) {
      const std::uint32_t p = t.parts->part[m];
      if (p != t.host && !t.moves[p]) t.moves[p] = movesAway(t, m);
    }
  }

  /// True for a member that is fast enough to be seen, or not much slower than the sweep found. One
  /// that was cut in vain before must be faster by its caution, or not much slower than its
  /// evidence says.
  bool movesAway(const Tried& t, std::uint32_t m) {
    constexpr double kMuch = 0.5;
    constexpr double kBarely = 0.1;  // of `seen`: for a part without a cut weld
    const BodyId b = t.c->members[m];
    if (place_[index(b)] == kNone) return true;  // nothing holds it
    const Evidence& against = t.against[t.parts->part[m]];
    const double speed = speedOf(*t.c, b, scratch_.sweep_u[index(b)]);
    const double seen = state_.settings.unmerging.sliding;
    if (against.caution > 1.0 && against.sum > 0.0) {
      return speed * against.steps > std::min(seen * against.caution, kMuch * against.sum);
    }
    if (against.steps == 0 && speed <= kBarely * seen) return false;
    if (speed * std::max(1, against.steps) > seen) return true;
    return speed > kMuch * speedOf(*t.c, b, velocityBefore(b));
  }

  /// Of a member's fastest corner against the collection [m/s].
  double speedOf(const Collection& c, BodyId b, const SolverVelocity& u) {
    OrientedBox box = state_.extent(rigidOf(b)).box;
    const Pose pose = state_.pose(b);
    box.frame = pose * box.frame;
    return fastestCorner(box, {pose.position, {u.vx, u.vy}, u.omega}, fieldOf(c.rigid));
  }

  struct Known {
    RigidId id;
    VelocityField field;
  };

  State& state_;
  Scratch& scratch_;
  std::vector<Tried> tried_;
  std::vector<std::uint32_t> of_slot_;      ///< per collection slot: in tried_
  std::vector<std::uint32_t> place_;        ///< per body: in touched_
  std::vector<SweepItem> items_;            ///< at bodies that could move
  std::vector<Impulses> impulses_;          ///< theirs before the trial
  std::vector<std::uint32_t> touched_;      ///< all bodies at the items
  std::vector<SolverVelocity> velocities_;  ///< theirs before the trial
  std::vector<std::uint32_t> bodies_;       ///< those that respond in the trial
  std::vector<Known> fields_;               ///< of collections that were asked for
};

/// Restores the grip of a weld that was cut, or lost contacts.
void holdOn(const State& state, Collection& c, std::uint32_t w) {
  Weld& weld = c.welds[w];
  weld.cut = false;
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    for (PointWatch& point : c.contacts[i].watch) point.lost = false;
  }
  updateGrip(state, c, w);
}

/// Forgets the evidence against a weld that stays.
void forget(const State& state, Collection& c, std::uint32_t w) {
  Weld& weld = c.welds[w];
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    for (PointWatch& point : c.contacts[i].watch) point.slip = point.opening = {};
  }
  weld.turning = {};
  holdOn(state, c, w);
  std::erase(c.loosened, w);
}

}  // namespace

bool withholdCuts(const State& state, Collection& c) {
  const auto withhold = [&](std::uint32_t w) {
    const Weld& weld = c.welds[w];
    if (std::max(state[weld.a].jolted, state[weld.b].jolted) == kFollowed) return false;
    holdOn(state, c, w);
    return true;
  };
  std::erase_if(c.cut_welds, withhold);
  std::erase_if(c.loosened, withhold);
  return c.cut_welds.empty() && c.loosened.empty();
}

namespace {

/// The parts that the trial leaves of one proposal.
std::optional<Parts> remains(State& state, Scratch& scratch, const Tried& t) {
  Collection& c = *t.c;
  const Parts& parts = *t.parts;
  const auto frame = static_cast<std::uint32_t>(t.moves.size());
  const auto partOf = [&](std::uint32_t node) {
    return node < parts.part.size() ? parts.part[node] : frame;
  };
  const auto leaves = [&](std::uint32_t part) { return part != frame && t.moves[part] != 0; };
  std::vector<std::uint32_t> leaving;  // welds
  for (std::uint32_t w = 0; w < c.welds.size(); ++w) {
    const std::uint32_t p = partOf(c.welds[w].node_a), q = partOf(c.welds[w].node_b);
    if (p == q) continue;
    if (!leaves(p) && !leaves(q)) {
      forget(state, c, w);
    } else if (!c.welds[w].cut) {
      leaving.push_back(w);
    }
  }
  std::erase_if(c.cut_welds, [&](std::uint32_t w) { return !c.welds[w].cut; });
  if (std::ranges::count(t.moves, 0) == std::ssize(t.moves)) return {};
  for (const std::uint32_t w : leaving) c.welds[w].cut = true;
  Parts result = judge(state, scratch, c);
  for (const std::uint32_t w : leaving) c.welds[w].cut = false;
  return result;
}

}  // namespace

std::vector<std::optional<Parts>> partsThatMove(State& state, Scratch& scratch,
                                                std::span<const Proposal> proposals) {
  std::vector<std::optional<Parts>> result;
  for (const Tried& t : Trial(state, scratch, proposals).run()) {
    result.push_back(t.fits ? remains(state, scratch, t) : *t.parts);
  }
  return result;
}

}  // namespace merge2d
