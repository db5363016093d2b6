#include "src2d/contact/parking.h"

#include <algorithm>

#include "src2d/contact/detection.h"
#include "src2d/contact/table.h"
#include "src2d/core/memory.h"

namespace merge2d {
namespace {

constexpr std::uint8_t kSteps = 4;      ///< for which it must have slept
constexpr std::int64_t kInterval = 64;  ///< steps until what could not become parked is tried anew

/// A pinned body: it never sleeps, and does not hold together the bodies that touch it.
bool isPinned(const State& state, RigidId id) {
  return !state.isCollection(id) && state[id].anchor == kWorldFrame;
}

/// Parked itself, or never in the way of it.
bool rests(const State& state, RigidId id) { return state.parked.holds(id) || isPinned(state, id); }

/// Counts the steps for which everything sleeps. True when it is time to look who may become
/// parked.
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

/// A collection that no stage changes any more.
bool isQuiet(const Collection& c) { return !c.stale; }

/// True for a rigid thing that may become parked if all that touch it may.
bool mayRest(const State& state, RigidId id) {
  const Rigid& r = state[id];
  if (!r.asleep || r.resized || state.parked.slept[index(id)] < kSteps) return false;
  if (r.anchor > kWorldFrame) return false;  // its frame may move again
  return !state.isCollection(id) || isQuiet(state.collection(id));
}

/// A body with a joint, a load or another tie that the lists of contacts do not tell must rest
/// anew.
void refuseHeld(State& state, const Scratch& scratch) {
  const auto refuse = [&](BodyId body) {
    std::uint8_t& steps = state.parked.slept[index(state[body].rigid)];
    if (steps != Parked::kHeld) steps = 0;
  };
  for (const Load& load : scratch.loads) refuse(load.body);
  for (const Joint& joint : state.joints) {
    if (joint.broken) continue;
    refuse(joint.a);
    if (!joint.to_world) refuse(joint.b);
  }
}

/// Whole sets of things that touch, of which each has slept for long enough.
std::vector<RigidId> chosen(State& state, Scratch& scratch) {
  refuseHeld(state, scratch);
  auto& sets = scratch.sets;
  sets.reset(state.rigids.size());
  for (const ContactTable::Slot slot : state.contacts.order) {
    const Contact& contact = state.contacts[slot];
    const RigidId a = state[contact.key.a].rigid, b = state[contact.key.b].rigid;
    if (contact.count == 0 || isPinned(state, a) || isPinned(state, b)) continue;
    sets.unite(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
  }
  std::vector<RigidId> all;
  std::vector<std::uint32_t> refused;  // sets
  for (const RigidId id : state.present) {
    if (isPinned(state, id)) continue;
    if (mayRest(state, id)) {
      all.push_back(id);
    } else {
      refused.push_back(sets.find(static_cast<std::uint32_t>(id)));
    }
  }
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
    const auto [a, b] = endsOf(pair);
    const bool goes = rests(state, a) && rests(state, b);
    const auto end = [&](RigidId id) {
      return state.parked.holds(id) ? id : ParkedPairs<Pair>::kNobody;
    };
    if (goes) aside.add(pair, end(a), end(b));
    return goes;
  });
}

std::pair<RigidId, RigidId> endsOf(const State& state, const ContactKey& key) {
  return {state[key.a].rigid, state[key.b].rigid};
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

/// Puts the entries that were added to the end of a list in their places.
template <class T, class KeyOf>
void sortTail(std::vector<T>& list, std::size_t known, KeyOf&& keyOf) {
  const auto middle = list.begin() + static_cast<std::ptrdiff_t>(known);
  std::ranges::sort(middle, list.end(), {}, keyOf);
  std::ranges::inplace_merge(list, middle, {}, keyOf);
}

/// Brings back those in `queue`, and all that touch them.
void bringBackSets(State& state, std::vector<RigidId>& queue) {
  ContactTable& table = state.contacts;
  auto& near = state.broadphase.near;
  const std::size_t contacts = table.order.size(), idle = table.idle.size(), known = near.size();
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
  }
  sortTail(table.order, contacts, [&](ContactTable::Slot slot) { return table[slot].key; });
  sortTail(table.idle, idle, &IdlePair::key);
  sortTail(near, known, [](const NearPair& pair) { return packed(index(pair.a), index(pair.b)); });
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
  collectPairs(state, scratch);
}

void bringBackAround(State& state, Scratch& scratch, BodyId body) {
  if (state.parked.count == 0) return;
  const RigidId id = state[body].rigid;
  std::vector<RigidId> queue;
  const auto add = [&](RigidId other) {
    if (state.parked.holds(other)) queue.push_back(other);
  };
  add(id);
  // A body that is never parked ties nothing together, but its pairs went with those that rest on
  // it. The boxes of a pair meet: the broadphase drops it where they do not.
  const bool is_tie = state[id].floating() || state.isCollection(id);
  if (!is_tie && state[id].present()) {
    state.broadphase.tree.queryLeaf(state[id].leaf,
                                    [&](std::uint32_t other) { add(RigidId{other}); });
  }
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
