#include "src2d/merging/parts.h"

#include <map>

#include "src2d/merging/collection.h"
#include "src2d/merging/rule.h"

namespace merge2d {
namespace {

/// All members welded to one body of the frame are one part, where the rule says so (see Floors in
/// merge.cpp). `nodeOf(node)` is the set of a weld's node in `parts`; `held(set)`: the frame holds
/// it.
template <class NodeOf, class Held>
void uniteOnFloors(const State& state, const Collection& c, NodeOf&& nodeOf, Held&& held,
                   DisjointSets& parts) {
  if (!mergingMethod(state).unites_on_floors) return;
  std::map<BodyId, std::uint32_t> on;  // per body of the frame: a node that it holds
  const auto frame = static_cast<std::uint32_t>(c.members.size());
  for (const Weld& weld : c.welds) {
    const bool to_frame = weld.node_a == frame || weld.node_b == frame;
    if (!to_frame || weld.cut || weld.expected) continue;
    const std::uint32_t node = nodeOf(weld.node_a == frame ? weld.node_b : weld.node_a);
    if (!held(node)) continue;
    parts.unite(node, on.emplace(weld.node_a == frame ? weld.a : weld.b, node).first->second);
  }
}

/// Numbers the parts in the order of the members.
template <class NodeOf, class Held>
Parts numbered(const Collection& c, NodeOf&& nodeOf, Held&& held, std::uint32_t nodes,
               DisjointSets& parts) {
  Parts result;
  std::vector<std::uint32_t> number(nodes, ~0u);
  for (std::uint32_t m = 0; m < c.members.size(); ++m) {
    const std::uint32_t node = nodeOf(m);
    std::uint32_t& p = number[parts.find(node)];
    if (p == ~0u) {
      p = static_cast<std::uint32_t>(result.anchored.size());
      result.anchored.push_back(0);
    }
    result.part.push_back(p);
    if (held(node)) result.anchored[p] = 1;
  }
  return result;
}

}  // namespace

int activeContacts(const Collection& c, const Weld& weld) {
  int active = weld.joints;
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    const InternalContact& inner = c.contacts[i];
    for (std::size_t p = 0; p < static_cast<std::size_t>(inner.count); ++p) {
      active += inner.watch[p].holds() ? 1 : 0;
    }
  }
  return active;
}

Parts componentsOf(const Collection& c) {
  const auto members = static_cast<std::uint32_t>(c.members.size());
  DisjointSets sets;
  sets.reset(members);
  std::vector<std::uint8_t> fixed(members, 0);
  for (const Weld& weld : c.welds) {
    if (weld.cut || weld.expected) continue;
    if (weld.node_a < members && weld.node_b < members) {
      sets.unite(weld.node_a, weld.node_b);
    } else {
      fixed[std::min(weld.node_a, weld.node_b)] = 1;  // to the frame, whose node is the last
    }
  }
  Parts parts;
  std::vector<std::uint32_t> number(members, ~0u);
  for (std::uint32_t m = 0; m < members; ++m) {
    std::uint32_t& p = number[sets.find(m)];
    if (p == ~0u) {
      p = static_cast<std::uint32_t>(parts.anchored.size());
      parts.anchored.push_back(0);
    }
    parts.part.push_back(p);
    parts.anchored[p] = static_cast<std::uint8_t>(parts.anchored[p] | fixed[m]);
  }
  return parts;
}

Parts connectedParts(const State& state, const Collection& c) {
  const auto frame = static_cast<std::uint32_t>(c.members.size());
  DisjointSets parts;
  parts.reset(frame);
  std::vector<std::uint8_t> on_frame(frame, 0);
  for (const Weld& weld : c.welds) {
    if (weld.cut || weld.expected || activeContacts(c, weld) == 0) continue;
    if (weld.node_a == frame || weld.node_b == frame) {
      on_frame[weld.node_a == frame ? weld.node_b : weld.node_a] = 1;
    } else {
      parts.unite(weld.node_a, weld.node_b);
    }
  }
  const auto nodeOf = [](std::uint32_t member) { return member; };
  const auto held = [&](std::uint32_t member) { return on_frame[member] != 0; };
  uniteOnFloors(state, c, nodeOf, held, parts);
  return numbered(c, nodeOf, held, frame, parts);
}

bool fallsApart(const State& state, const Collection& c, const Parts& parts) {
  return parts.anchored.size() > 1 || (parts.anchored[0] != 0) != !state[c.rigid].floating();
}

}  // namespace merge2d
