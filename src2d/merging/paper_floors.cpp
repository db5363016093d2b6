/// In the paper a pinned body is a member like any other: what is welded to one floor is one
/// collection.

#include <map>

#include "src2d/collections/collection.h"
#include "src2d/contact/parking.h"
#include "src2d/merging/merge.h"
#include "src2d/merging/paper_rule.h"

namespace merge2d {
namespace {

/// Unites the collections that are welded to one body of a frame.
class Floors {
 public:
  explicit Floors(State& state) : state_(state) {
    for (const Collection& c : state.collections) {
      if (c.id == kNoCollection) continue;
      for (const Weld& weld : c.welds) {
        const bool a_in = state[weld.a].rigid == c.rigid, b_in = state[weld.b].rigid == c.rigid;
        if (a_in != b_in) on_[a_in ? weld.b : weld.a] = a_in ? weld.a : weld.b;
      }
    }
  }

  void add(BodyId floor, BodyId member) {
    const auto [other, first] = on_.emplace(floor, member);
    const RigidId one = state_[member].rigid, two = state_[other->second].rigid;
    if (!first && one != two) mergeRigids(state_, one, two);
  }

 private:
  State& state_;
  std::map<BodyId, BodyId> on_;  ///< a member that is welded to each of them
};

}  // namespace

void weldPairsAndFloors(State& state, Scratch& scratch, const std::vector<BodyPair>& pairs) {
  bringAllBack(state, scratch);  // what sleeps on a floor may be united too
  Floors floors(state);
  weldPairs(state, scratch, pairs, [&](BodyId floor, BodyId member) { floors.add(floor, member); });
}

void uniteOnFloors(const Collection& c, PartFinder& finder) {
  std::map<BodyId, std::uint32_t> on;  // per body of the frame: a member that it holds
  for (const Weld& weld : c.welds) {
    const std::uint32_t member = finder.fixedBy(weld);
    const bool to_frame = member != kNone;
    if (!to_frame || weld.cut || weld.expected || !finder.isFixed(member)) continue;
    const BodyId floor = member == weld.node_a ? weld.b : weld.a;
    finder.unite(member, on.emplace(floor, member).first->second);
  }
}

Parts connectedParts(const State& state, const Collection& c) {
  PartFinder finder(c);
  for (const Weld& weld : c.welds) {
    if (!weld.cut && !weld.expected && activeContacts(c, weld) > 0) finder.join(weld);
  }
  mergingMethod(state).uniteParts(c, finder);
  return finder.parts();
}

}  // namespace merge2d
