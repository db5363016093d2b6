#include "src2d/merging/trial.h"

#include <algorithm>
#include <optional>

#include "src2d/dynamics/nncg.h"
#include "src2d/merging/grip.h"
#include "src2d/merging/metric.h"
#include "src2d/merging/refine.h"
#include "src2d/merging/spare_welds.h"

namespace merge2d {
namespace {

/// The contacts of all parts but the largest, solved as if they were free.
class Trial {
 public:
  Trial(State& state, Scratch& scratch, Collection& c, const Parts& parts)
      : state_(state),
        scratch_(scratch),
        c_(c),
        parts_(parts),
        host_(largest(parts)),
        kept_(scratch.sweep_u.size(), 0) {}

  bool fits() const {
    const std::size_t movers = static_cast<std::size_t>(
        std::ranges::count_if(parts_.part, [&](std::uint32_t p) { return p != host_; }));
    const bool anchored = parts_.anchored[host_] != 0;
    return anchored != state_[c_.rigid].floating() && movers > 0 && 2 * movers < parts_.part.size();
  }

  /// Per part: whether it would move.
  std::vector<std::uint8_t> run() {
    list();
    remember();
    freeze();
    solve();
    std::vector<std::uint8_t> moves(parts_.anchored.size(), 0);
    for (std::uint32_t m = 0; m < parts_.part.size(); ++m) {
      const std::uint32_t p = parts_.part[m];
      if (p != host_ && !moves[p]) moves[p] = movesAway(m);
    }
    restore();
    return moves;
  }

  std::uint32_t host() const { return host_; }

 private:
  static std::uint32_t largest(const Parts& parts) {
    std::vector<std::size_t> size(parts.anchored.size(), 0);
    for (const std::uint32_t p : parts.part) ++size[p];
    return static_cast<std::uint32_t>(std::ranges::max_element(size) - size.begin());
  }

  std::size_t membersOf(std::uint32_t part) const {
    return static_cast<std::size_t>(std::ranges::count(parts_.part, part));
  }

  bool isMover(std::uint32_t body) const {
    return body < state_.bodies.size() && state_.bodies[body].rigid == c_.rigid &&
           parts_.part[state_[rigidOf(BodyId{body})].member] != host_;
  }

  /// Lists what the movers touch, and over how many steps each part was found to part.
  void list() {
    const Rotation turn = state_[c_.rigid].rotation;
    steps_.assign(parts_.anchored.size(), 1);
    const auto partOf = [&](std::uint32_t node) {
      return node < parts_.part.size() ? parts_.part[node] : host_;
    };
    for (const Weld& weld : c_.welds) {
      const std::uint32_t p = partOf(weld.node_a), q = partOf(weld.node_b);
      if (p == host_ && q == host_) continue;
      for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
        items_.push_back({&c_.blocks[c_.contact_block[i]], nullptr, turn});
      }
      if (!weld.cut) continue;
      for (const std::uint32_t part : {p, q}) steps_[part] = std::max(steps_[part], stepsOf(weld));
    }
    for (JointBlock& k : c_.joints) {
      if (isMover(k.a) || isMover(k.b)) items_.push_back({nullptr, &k, turn});
    }
    for (SweepContact& outer : scratch_.sweep_contacts) {
      if (isMover(outer.block.a) || isMover(outer.block.b)) {
        items_.push_back({&outer.block, nullptr, {}});
      }
    }
    for (JointBlock& k : scratch_.sweep_joints) {
      if (isMover(k.a) || isMover(k.b)) items_.push_back({nullptr, &k, {}});
    }
  }

  /// Over how many steps the evidence against a weld was summed.
  int stepsOf(const Weld& weld) const {
    if (weld.reason == EventReason::RelativeMotion) return weld.turning.steps;
    int steps = 1;
    for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
      for (const PointWatch& point : c_.contacts[i].watch) {
        const bool slid = weld.reason == EventReason::Sliding;
        steps = std::max(steps, slid ? point.slip.steps : point.opening.steps);
      }
    }
    return steps;
  }

  void remember() {
    for (const SweepItem& item : items_) {
      impulses_.push_back(item.impulses());
      for (const std::uint32_t b : {item.a(), item.b()}) {
        if (kept_[b]) continue;
        kept_[b] = 1;
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

  /// What moves as a part of a collection gets its velocity, and does not respond.
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

  /// Of a collection at the end of this step: what floats has the momentum of its members.
  VelocityField fieldOf(RigidId id) {
    const Rigid& r = state_[id];
    if (!r.floating()) return {r.x, r.v, r.omega};
    auto known = std::ranges::find(fields_, id, &Known::id);
    if (known != fields_.end()) return known->field;
    const Collection& c = state_.collection(id);
    const Pose frame = r.frame();
    Vec2 p = Vec2::Zero();
    double l = 0.0;
    for (const BodyId b : c.members) {
      const Body& body = state_[b];
      const auto kept = std::ranges::find(touched_, static_cast<std::uint32_t>(b));
      const SolverVelocity& u =
          kept == touched_.end() ? scratch_.sweep_u[index(b)]
                                 : velocities_[static_cast<std::size_t>(kept - touched_.begin())];
      const Vec2 v(u.vx, u.vy);
      p += body.mass * v;
      l += body.mass * cross(frame * body.local - r.x, v) + body.inertia * u.omega;
    }
    const VelocityField field{r.x, p * r.inv_mass, l * r.inv_inertia};
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
    iteration.run(most, method == SolverMethod::Nncg);
  }

  /// Fast enough to be seen, or not much slower than the sweep found.
  bool movesAway(std::uint32_t m) {
    constexpr double kMuch = 0.5;
    const auto b = static_cast<std::uint32_t>(c_.members[m]);
    const double speed = speedOf(b, scratch_.sweep_u[b]);
    const auto found = std::ranges::find(touched_, b);
    if (found == touched_.end()) return true;  // nothing holds it
    if (speed * steps_[parts_.part[m]] > state_.settings.unmerging.sliding) return true;
    const auto place = static_cast<std::size_t>(found - touched_.begin());
    return speed > kMuch * speedOf(b, velocities_[place]);
  }

  /// Of a member's fastest corner against the collection [m/s].
  double speedOf(std::uint32_t body, const SolverVelocity& u) {
    const BodyId b{body};
    OrientedBox box = state_.extent(rigidOf(b)).box;
    const Pose pose = state_.pose(b);
    box.frame = pose * box.frame;
    return fastestCorner(box, {pose.position, {u.vx, u.vy}, u.omega}, fieldOf(c_.rigid));
  }

  struct Known {
    RigidId id;
    VelocityField field;
  };

  State& state_;
  Scratch& scratch_;
  Collection& c_;
  const Parts& parts_;
  std::uint32_t host_;                      ///< the largest part
  std::vector<std::uint8_t> kept_;          ///< per body: is in touched_
  std::vector<SweepItem> items_;            ///< at what could move
  std::vector<Impulses> impulses_;          ///< theirs before the trial
  std::vector<std::uint32_t> touched_;      ///< all bodies at the items
  std::vector<SolverVelocity> velocities_;  ///< theirs before the trial
  std::vector<std::uint32_t> bodies_;       ///< those that respond in the trial
  std::vector<int> steps_;                  ///< per part: of the evidence against it
  std::vector<Known> fields_;               ///< of collections that float
};

/// A weld that was cut, or lost contacts, holds by all that it held by before.
void holdOn(const State& state, Collection& c, std::uint32_t w) {
  Weld& weld = c.welds[w];
  weld.cut = false;
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    for (PointWatch& point : c.contacts[i].watch) point.lost = false;
  }
  updateGrip(state, c, w);
}

/// The welds that stay are as if nothing had been found.
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

void withholdCuts(const State& state, Collection& c) {
  for (const std::uint32_t w : c.cut_welds) holdOn(state, c, w);
  for (const std::uint32_t w : c.loosened) holdOn(state, c, w);
  c.cut_welds.clear();
  c.loosened.clear();
}

std::optional<Parts> partsThatMove(State& state, Scratch& scratch, Collection& c,
                                   const Parts& parts) {
  Trial trial(state, scratch, c, parts);
  if (!trial.fits()) return parts;
  const std::vector<std::uint8_t> moves = trial.run();
  const auto frame = static_cast<std::uint32_t>(moves.size());
  const auto partOf = [&](std::uint32_t node) {
    return node < parts.part.size() ? parts.part[node] : frame;
  };
  const auto leaves = [&](std::uint32_t part) { return part != frame && moves[part] != 0; };
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
  if (std::ranges::count(moves, 0) == std::ssize(moves)) return {};
  for (const std::uint32_t w : leaving) c.welds[w].cut = true;
  Parts result = judge(state, scratch, c);
  for (const std::uint32_t w : leaving) c.welds[w].cut = false;
  return result;
}

}  // namespace merge2d
