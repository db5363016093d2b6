#include <map>

#include "src2d/merging/paper_rule.h"

namespace merge2d {
namespace {

/// All members welded to one body of the frame are one part, where the rule says so (see Floors in
/// merge.cpp).
void uniteOnFloors(const State& state, const Collection& c, PartFinder& finder) {
  if (!mergingMethod(state).unites_on_floors) return;
  std::map<BodyId, std::uint32_t> on;  // per body of the frame: a member that it holds
  for (const Weld& weld : c.welds) {
    const std::uint32_t member = finder.fixedBy(weld);
    const bool to_frame = member != kNone;
    if (!to_frame || weld.cut || weld.expected || !finder.isFixed(member)) continue;
    const BodyId floor = member == weld.node_a ? weld.b : weld.a;
    finder.unite(member, on.emplace(floor, member).first->second);
  }
}

}  // namespace

Parts connectedParts(const State& state, const Collection& c) {
  PartFinder finder(c);
  for (const Weld& weld : c.welds) {
    if (!weld.cut && !weld.expected && activeContacts(c, weld) > 0) finder.join(weld);
  }
  uniteOnFloors(state, c, finder);
  return finder.parts();
}

}  // namespace merge2d
