#include "src2d/merging/group_notes.h"

#include <algorithm>
#include <map>
#include <set>

#include "src2d/merging/grip.h"

namespace merge2d {
namespace {

/// Collects the bodies of one group.
class Gatherer {
 public:
  void touching(BodyId body) { touching_.insert(body); }
  void welded(BodyId body) { welded_.insert(body); }

  Group group() const {
    Group all(touching_.begin(), touching_.end());
    std::set_difference(welded_.begin(), welded_.end(), touching_.begin(), touching_.end(),
                        std::back_inserter(all));
    return all;
  }

 private:
  std::set<BodyId> touching_, welded_;
};

/// Gives groups their place in the notes, once each.
class GroupList {
 public:
  explicit GroupList(Notes& notes) : notes_(notes) {}

  Gatherer& operator[](std::uint32_t key) { return gathered_[key]; }

  /// To be called when all are gathered.
  void write() {
    for (const auto& [key, gatherer] : gathered_) {
      place_[key] = static_cast<std::int32_t>(notes_.groups.size());
      notes_.groups.push_back(gatherer.group());
    }
  }

  void nameIn(Decision& decision, std::uint32_t key) const {
    decision.members = place_.at(key);
    decision.group = static_cast<std::int32_t>(
        notes_.groups[static_cast<std::size_t>(decision.members)].front());
  }

 private:
  Notes& notes_;
  std::map<std::uint32_t, Gatherer> gathered_;
  std::map<std::uint32_t, std::int32_t> place_;
};

/// Pinned or scripted: a body that collections can be fixed to.
bool isFrame(const State& state, BodyId body) {
  return !state[rigidOf(body)].floating() && !state.isCollection(state[body].rigid);
}

}  // namespace

bool stillTogether(const State& state, BodyId a, BodyId b) {
  const Rigid &ra = state.rigid(a), &rb = state.rigid(b);
  return &ra == &rb || (!ra.floating() && ra.anchor == rb.anchor);
}

void noteGroups(const State& state, Scratch& scratch, const Groups& group) {
  if (!scratch.notes) return;
  const auto held = [&](const ReadyPair& edge) {
    return !group.empty() && group[edge.node_a] == group[edge.node_b];
  };
  GroupList groups(*scratch.notes);
  std::set<RigidId> seen;
  for (const ReadyPair& edge : scratch.ready) {
    if (!held(edge)) continue;
    Gatherer& gatherer = groups[group[edge.node_a]];
    for (const BodyId body : {edge.pair.a, edge.pair.b}) {
      gatherer.touching(body);
      const RigidId rigid = state[body].rigid;
      if (!state.isCollection(rigid) || !seen.insert(rigid).second) continue;
      for (const BodyId member : state.collection(rigid).members) gatherer.welded(member);
    }
  }
  groups.write();
  for (const ReadyPair& edge : scratch.ready) {
    Decision test{.criterion = "cycle",
                  .equation = "Section 8.2",
                  .value = static_cast<double>(edge.contacts),
                  .threshold = 2.0,
                  .verdict = held(edge) ? "merge" : "wait"};
    if (held(edge)) groups.nameIn(test, group[edge.node_a]);
    noteMerge(state, scratch.notes, edge.pair, test);
  }
}

void noteBrokenGroups(const State& state, const Collection& before, Notes* notes) {
  if (!notes) return;
  // The parts as they are now, joined again where a weld ended; a frame joins nothing.
  DisjointSets parts;
  parts.reset(state.rigids.size());
  const auto part = [&](BodyId body) {
    return parts.find(static_cast<std::uint32_t>(state[body].rigid));
  };
  const auto ended = [&](const Weld& weld) { return !stillTogether(state, weld.a, weld.b); };
  const auto own = [&](const Weld& weld) { return isFrame(state, weld.a) ? weld.b : weld.a; };
  for (const Weld& weld : before.welds) {
    if (!ended(weld) || isFrame(state, weld.a) || isFrame(state, weld.b)) continue;
    parts.unite(part(weld.a), part(weld.b));
  }
  GroupList groups(*notes);
  std::set<std::uint32_t> told;
  for (const Weld& weld : before.welds) {
    if (ended(weld) && !weld.cut) told.insert(part(own(weld)));
  }
  for (const Weld& weld : before.welds) {
    const std::uint32_t key = part(own(weld));
    if (!told.contains(key)) continue;
    for (const BodyId body : {weld.a, weld.b}) {
      ended(weld) ? groups[key].touching(body) : groups[key].welded(body);
    }
  }
  groups.write();
  for (const Weld& weld : before.welds) {
    if (weld.cut || !ended(weld)) continue;
    Decision test{.a = weld.a,
                  .b = weld.b,
                  .stage = "Unmerge",
                  .criterion = "cycle",
                  .equation = "Section 8.2",
                  .value = static_cast<double>(activeContacts(before, weld)),
                  .threshold = 2.0,
                  .verdict = "unmerge"};
    groups.nameIn(test, part(own(weld)));
    notes->decisions.push_back(test);
  }
}

}  // namespace merge2d
