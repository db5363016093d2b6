#include "src2d/merging/doubt_spread.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "src2d/collections/collection.h"
#include "src2d/merging/disturbance.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/relaxation/open_solve.h"

namespace merge2d {
namespace {

void lengthen(HitRun& run, std::int64_t step) {
  if (run.last + 1 < step) run.first = step;
  run.last = step;
}

/// A few of many disjoint sets.
class SetNames {
 public:
  void add(std::uint32_t name) { names_.push_back(name); }
  /// To be called between the last `add` and the first `contains`.
  void sort() {
    std::ranges::sort(names_);
    names_.erase(std::unique(names_.begin(), names_.end()), names_.end());
  }
  bool contains(std::uint32_t name) const { return std::ranges::binary_search(names_, name); }

 private:
  std::vector<std::uint32_t> names_;
};

}  // namespace

void spreadHits(State& state, Scratch& scratch) {
  auto& sets = scratch.sets;
  sets.reset(state.collections.size());
  const auto slotOf = [&](BodyId b) -> std::ptrdiff_t {
    const RigidId id = state[b].rigid;
    if (!state.isCollection(id) || state[id].asleep) return -1;
    return static_cast<std::ptrdiff_t>(index(id) - state.bodies.size());
  };
  const auto unite = [&](BodyId a, BodyId b) {
    const auto p = slotOf(a), q = slotOf(b);
    if (p >= 0 && q >= 0) sets.unite(static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(q));
  };
  for (const BodyPair& pair : scratch.pairs) unite(pair.a, pair.b);
  for (const std::uint32_t i : state.joint_lists.present) {
    const Joint& joint = state.joints[i];
    if (!joint.to_world && holds(state, joint)) unite(joint.a, joint.b);
  }
  const auto setOf = [&](const Collection& c) {
    return sets.find(static_cast<std::uint32_t>(state.collections.slotOf(c)));
  };
  SetNames hit, met;
  for (const Collection& c : state.collections) {
    if (!isSwept(state, c) || !isHit(state, c)) continue;
    hit.add(setOf(c));
    if (state.step - c.hits.met < hitSteps(state)) met.add(setOf(c));
  }
  hit.sort();
  met.sort();
  for (Collection& c : state.collections) {
    if (!isSwept(state, c) || !hit.contains(setOf(c))) continue;
    scratch.doubts[state.collections.slotOf(c)] = Doubt::Open;
    if (met.contains(setOf(c))) lengthen(c.hits, state.step);
  }
}

namespace {

/// The rigid things that float and are hit or kicked, or jerked by a joint.
std::vector<RigidId> struckRigids(const State& state, const Scratch& scratch) {
  std::vector<RigidId> struck;
  const auto add = [&](BodyId b) {
    if (state.rigid(b).floating() && !state.rigid(b).asleep) struck.push_back(state[b].rigid);
  };
  const double impact = impactSpeed(state);
  for (const Meeting& m : scratch.meetings) {
    if (m.speed <= impact) continue;
    add(scratch.pairs[m.pair].a);
    add(scratch.pairs[m.pair].b);
  }
  for (const Kick& kick : scratch.kicks) {
    if (kick.impulse.norm() * state.rigid(kick.body).inv_mass > impact) add(kick.body);
  }
  for (const std::uint32_t i : state.joint_lists.present) {
    const Joint& joint = state.joints[i];
    if (!holds(state, joint) || isInside(state, joint)) continue;
    if (jerkOf(state, joint) <= impact) continue;
    add(joint.a);
    if (!joint.to_world) add(joint.b);
  }
  return struck;
}

/// Things that pass a blow on: floating ones, and collections.
bool passesBlows(const State& state, BodyId b) {
  const Rigid& r = state.rigid(b);
  return !r.asleep && (r.floating() || state.isMember(b));
}

void unite(const State& state, Scratch& scratch, BodyId a, BodyId b) {
  if (!passesBlows(state, a) || !passesBlows(state, b)) return;
  scratch.sets.unite(static_cast<std::uint32_t>(state[a].rigid),
                     static_cast<std::uint32_t>(state[b].rigid));
}

/// The rigid things that hang together by joints.
void uniteJoined(const State& state, Scratch& scratch) {
  scratch.sets.reset(state.rigids.size());
  for (const std::uint32_t i : state.joint_lists.present) {
    const Joint& joint = state.joints[i];
    if (!joint.to_world && holds(state, joint)) unite(state, scratch, joint.a, joint.b);
  }
}

enum class Way { Joints, Contacts };

/// Has the solve asked about the collections, floating or not, that hang together with one of
/// these; by joints also about one in which impulses are sought for the load that there was.
void markReached(State& state, Scratch& scratch, std::span<const RigidId> struck, bool floating,
                 Way by) {
  const auto setOf = [&](RigidId id) { return scratch.sets.find(static_cast<std::uint32_t>(id)); };
  SetNames reached;
  for (const RigidId id : struck) reached.add(setOf(id));
  reached.sort();
  for (Collection& c : state.collections) {
    if (!isSwept(state, c) || state[c.rigid].floating() != floating) continue;
    if (!reached.contains(setOf(c.rigid))) continue;
    Doubt& doubt = scratch.doubts[state.collections.slotOf(c)];
    const bool sought = by == Way::Joints && doubt == Doubt::Search;
    if (doubt == Doubt::None || (sought && (!floating || c.settled))) {  // or it looks ahead
      doubt = Doubt::Reached;
    } else if (sought) {
      doubt = Doubt::Open;
      c.hits.blow = state.step;
    }
  }
}

}  // namespace

void noteReached(State& state, Scratch& scratch) {
  std::vector<RigidId> struck = struckRigids(state, scratch);
  if (struck.empty()) return;
  uniteJoined(state, scratch);
  for (const bool floating : {true, false}) {
    markReached(state, scratch, struck, floating, Way::Joints);
  }
  for (const BodyPair& pair : scratch.pairs) unite(state, scratch, pair.a, pair.b);
  std::erase_if(struck, [&](RigidId id) { return state.isCollection(id); });
  markReached(state, scratch, struck, false, Way::Contacts);
}

void askJoined(State& state, Scratch& scratch) {
  if (state.joint_lists.present.empty()) return;
  std::vector<RigidId> open;
  for (const Collection& c : state.collections) {
    if (doubtAbout(state, scratch, c) == Doubt::Open) open.push_back(c.rigid);
  }
  if (open.empty()) return;
  uniteJoined(state, scratch);
  markReached(state, scratch, open, false, Way::Joints);
}

void openWhatFramesDrag(const State& state, Scratch& scratch) {
  const auto moves = [&](BodyId b) { return state.rigid(b).isOnMovingFrame(); };
  const auto open = [&](BodyId body) {
    if (!state.isMember(body)) return;
    const Collection& c = state.collection(state[body].rigid);
    if (isSwept(state, c)) scratch.doubts[state.collections.slotOf(c)] = Doubt::Open;
  };
  for (const BodyPair& pair : scratch.pairs) {
    if (!areOnTwoFrames(state.rigid(pair.a), state.rigid(pair.b))) continue;
    if (moves(pair.a) || moves(pair.b)) open(pair.a), open(pair.b);
  }
  for (const std::uint32_t i : state.joint_lists.present) {
    const Joint& joint = state.joints[i];
    if (!holds(state, joint) || !isOnTwoFrames(state, joint)) continue;
    const BodyId b = joint.to_world ? joint.a : joint.b;
    if (moves(joint.a) || moves(b)) open(joint.a), open(b);
  }
}

}  // namespace merge2d
