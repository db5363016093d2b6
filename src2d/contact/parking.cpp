#include "src2d/contact/parking.h"

#include <algorithm>

#include "src2d/contact/detection.h"
#include "src2d/contact/table.h"
#include "src2d/core/memory.h"
#include "src2d/core/sorted_tail.h"

namespace merge2d {
namespace {

constexpr std::uint8_t kSteps = kStepsUntilParked;
constexpr std::int64_t kInterval = 64;  ///< steps until the others are looked at anew

/// A body that stands still by itself, pinned or at rest in its script: it never sleeps, and does
/// not hold together the bodies that touch it.
bool isFixed(const State& state, RigidId id) {
  return !state.isCollection(id) && !state[id].floating() && state[id].still();
}

/// Parked itself, or fixed.
bool rests(const State& state, RigidId id) { return state.parked.holds(id) || isFixed(state, id); }

/// Counts the steps for which each rigid thing has slept. True when some may have become ready to
/// be parked.
bool countSteps(State& state) {
  auto& slept = state.parked.slept;
  resizeTightly(slept, std::max(slept.size(), state.rigids.size()));
  const bool again = state.step % kInterval == 0;
  bool ripe = false;
  for (const RigidId id : state.present) {
    std::uint8_t& steps = slept[index(id)];
    if (!state[id].asleep) {
      steps = 0;
    } else if (steps < kSteps) {
      ripe |= ++steps == kSteps;
    } else {
      ripe |= again;
    }
  }
  return ripe;
}

/// True for a rigid thing that may become parked if all that touch it may.
bool mayRest(const State& state, RigidId id) {
  const Rigid& r = state[id];
  if (!r.asleep || r.resized || state.parked.slept[index(id)] < kSteps) return false;
  if (!state.isCollection(id)) return true;
  const Collection& c = state.collection(id);
  return !c.stale && (r.floating() || r.anchor == kWorldFrame || isFixed(state, rigidOf(c.anchor)));
}

std::pair<RigidId, RigidId> endsOf(const State& state, const ContactKey& key) {
  return {state[key.a].rigid, state[key.b].rigid};
}

/// The world is no rigid thing: the first body stands for it, too.
std::pair<RigidId, RigidId> endsOf(const State& state, const Joint& joint) {
  const RigidId a = state[joint.a].rigid;
  return {a, joint.to_world ? a : state[joint.b].rigid};
}

/// Sets of things that touch, or that a joint holds together.
void uniteWhatIsTied(const State& state, DisjointSets& sets) {
  sets.reset(state.rigids.size());
  const auto unite = [&](const std::pair<RigidId, RigidId>& ends) {
    const auto [a, b] = ends;
    if (isFixed(state, a) || isFixed(state, b)) return;
    sets.unite(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
  };
  for (const ContactTable::Slot slot : state.contacts.order) {
    const Contact& contact = state.contacts[slot];
    if (contact.count > 0) unite(endsOf(state, contact.key));
  }
  for (const std::uint32_t i : state.joint_lists.present) unite(endsOf(state, state.joints[i]));
}

/// Whole sets of which each thing has slept for long enough, and carries no load: those are summed
/// in each step.
std::vector<RigidId> chosen(const State& state, Scratch& scratch) {
  auto& sets = scratch.sets;
  uniteWhatIsTied(state, sets);
  std::vector<RigidId> all;
  std::vector<std::uint32_t> refused;  // sets
  const auto refuse = [&](RigidId id) {
    refused.push_back(sets.find(static_cast<std::uint32_t>(id)));
  };
  for (const RigidId id : state.present) {
    if (isFixed(state, id)) continue;
    if (mayRest(state, id)) {
      all.push_back(id);
    } else {
      refuse(id);
    }
  }
  for (const Load& load : scratch.loads) refuse(state[load.body].rigid);
  std::ranges::sort(refused);
  std::erase_if(all, [&](RigidId id) {
    return std::ranges::binary_search(refused, sets.find(static_cast<std::uint32_t>(id)));
  });
  return all;
}

/// Moves pairs of which nobody can move out of their list.
template <class Pair, class EndsOf>
void setPairsAside(const State& state, std::vector<Pair>& list, ParkedPairs<Pair>& aside,
                   EndsOf&& endsOf) {
  std::erase_if(list, [&](const Pair& pair) {
    constexpr RigidId kNobody = ParkedPairs<Pair>::kNobody;
    const auto [a, b] = endsOf(pair);
    const auto end = [&](RigidId id) { return state.parked.holds(id) ? id : kNobody; };
    const bool any = end(a) != kNobody || end(b) != kNobody;
    const bool goes = any && rests(state, a) && rests(state, b);
    if (goes) aside.add(pair, end(a), end(b));
    return goes;
  });
}

/// How many floating bodies a rigid thing counts for.
int bodiesOf(const State& state, RigidId id) {
  return state.isCollection(id) ? static_cast<int>(state.collection(id).members.size()) : 1;
}

void setAside(State& state, RigidId id) {
  Parked& parked = state.parked;
  parked.slept[index(id)] = Parked::kHeld;
  ++parked.count;
  parked.bodies += bodiesOf(state, id);
  state.present.erase(id);
  if (!state.isCollection(id)) return;
  ++parked.collections;
  state.collections.setAside(index(id) - state.bodies.size());
}

/// The counterpart.
void takeBack(State& state, RigidId id) {
  Parked& parked = state.parked;
  parked.slept[index(id)] = 0;
  --parked.count;
  parked.bodies -= bodiesOf(state, id);
  state.present.insert(id);
  if (!state.isCollection(id)) return;
  --parked.collections;
  state.collections.bringBack(index(id) - state.bodies.size());
}

/// Appends the rigid thing of a body, if it is parked. Of a body that is never parked all that is
/// near it, and all that a joint holds to it: their pairs with it were set aside with them. The
/// boxes of such a pair meet, as the broadphase drops it where they do not.
void addAround(const State& state, BodyId body, std::vector<RigidId>& queue) {
  const auto add = [&](RigidId id) {
    if (state.parked.holds(id)) queue.push_back(id);
  };
  const RigidId id = state[body].rigid;
  add(id);
  if (state[id].floating() || state.isCollection(id) || !state[id].present()) return;
  state.broadphase.tree.queryLeaf(state[id].leaf,
                                  [&](std::uint32_t other) { add(RigidId{other}); });
  state.joint_lists.of_body.forEach(body, [&](std::uint32_t joint) {
    const auto [a, b] = endsOf(state, state.joints[joint]);
    add(a);
    add(b);
  });
}

/// Brings back those in `queue`, and all that touch them or hang together with them by joints.
void bringBackSets(State& state, std::vector<RigidId>& queue) {
  ContactTable& table = state.contacts;
  JointLists& joints = state.joint_lists;
  auto& near = state.broadphase.near;
  while (!queue.empty()) {
    const RigidId id = queue.back();
    queue.pop_back();
    if (!state.parked.holds(id)) continue;
    takeBack(state, id);
    table.parked.take(id, [&](ContactTable::Slot slot, RigidId other) {
      table.order.push_back(slot);
      if (table[slot].count > 0 && other != ParkedPairs<ContactTable::Slot>::kNobody)
        queue.push_back(other);
    });
    table.parked_idle.take(id, [&](const IdlePair& pair, RigidId) { table.idle.push_back(pair); });
    state.broadphase.parked_near.take(id,
                                      [&](const NearPair& pair, RigidId) { near.push_back(pair); });
    joints.parked.take(id, [&](std::uint32_t joint, RigidId other) {
      joints.present.push_back(joint);
      if (other != ParkedPairs<std::uint32_t>::kNobody) queue.push_back(other);
    });
  }
  sortTail(table.order,
           [&](ContactTable::Slot x, ContactTable::Slot y) { return table[x].key < table[y].key; });
  sortTail(table.idle, [](const IdlePair& x, const IdlePair& y) { return x.key < y.key; });
  sortTail(near);
  sortTail(joints.present);
}

}  // namespace

void parkSleepers(State& state, Scratch& scratch) {
  if (!sleeps(state.mode) || !countSteps(state)) return;
  const std::vector<RigidId> ids = chosen(state, scratch);
  if (ids.empty()) return;
  for (const RigidId id : ids) setAside(state, id);
  ContactTable& table = state.contacts;
  setPairsAside(state, table.order, table.parked,
                [&](ContactTable::Slot slot) { return endsOf(state, table[slot].key); });
  setPairsAside(state, table.idle, table.parked_idle,
                [&](const IdlePair& pair) { return endsOf(state, pair.key); });
  setPairsAside(state, state.broadphase.near, state.broadphase.parked_near,
                [](const NearPair& pair) { return std::pair(pair.a, pair.b); });
  setPairsAside(state, state.joint_lists.present, state.joint_lists.parked,
                [&](std::uint32_t joint) { return endsOf(state, state.joints[joint]); });
  collectPairs(state, scratch);
}

void bringBackAround(State& state, Scratch& scratch, const std::vector<BodyId>& bodies) {
  if (state.parked.count == 0) return;
  std::vector<RigidId> queue;
  for (const BodyId body : bodies) addAround(state, body, queue);
  if (queue.empty()) return;
  bringBackSets(state, queue);
  collectPairs(state, scratch);
}

void bringAllBack(State& state, Scratch& scratch) {
  if (state.parked.count == 0) return;
  std::vector<RigidId> queue;
  for (std::uint32_t i = 0; i < state.parked.slept.size(); ++i) {
    if (state.parked.holds(RigidId{i})) queue.push_back(RigidId{i});
  }
  bringBackSets(state, queue);
  collectPairs(state, scratch);
}

void bringBackActedOn(State& state, const Scratch& scratch) {
  if (state.parked.count == 0) return;
  std::vector<RigidId> queue;
  const auto add = [&](BodyId body) {
    if (state.parked.holds(state[body].rigid)) queue.push_back(state[body].rigid);
  };
  for (const Kick& kick : scratch.kicks) add(kick.body);
  for (const Load& load : scratch.loads) add(load.body);
  for (const BodyId body : scratch.stirred) add(body);
  if (!queue.empty()) bringBackSets(state, queue);
}

void bringBackTouched(State& state) {
  if (state.parked.count == 0) return;
  std::vector<RigidId> queue;
  for (const ContactTable::Slot slot : state.contacts.order) {
    const Contact& contact = state.contacts[slot];
    if (contact.count == 0) continue;
    const auto [a, b] = endsOf(state, contact.key);
    for (const RigidId id : {a, b}) {
      if (state.parked.holds(id)) queue.push_back(id);
    }
  }
  if (!queue.empty()) bringBackSets(state, queue);
}

}  // namespace merge2d
