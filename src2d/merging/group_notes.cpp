#include "src2d/merging/group_notes.h"

#include <algorithm>
#include <map>
#include <set>

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

/// Section 8.2, or docs/cycles.md: a pair with fewer than two contacts needs its group.
Criterion isHeldByGroup(const State& state, const ReadyPair& edge, bool by_group) {
  const bool by_cycles = state.settings.merging.cycles == CycleCriterion::Triangle;
  return {"cycle", by_cycles ? "Section 8.2" : kOwnCycles, static_cast<double>(edge.contacts), 2.0,
          by_group};
}

}  // namespace

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
    const Criterion test = isHeldByGroup(state, edge, held(edge));
    Decision* d = recordMerge(state, scratch.notes, edge.pair, test);
    if (d && test.holds) groups.nameIn(*d, group[edge.node_a]);
  }
}

}  // namespace merge2d
