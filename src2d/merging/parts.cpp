#include "src2d/merging/parts.h"

#include <map>

#include "src2d/merging/collection.h"
#include "src2d/merging/cycles.h"
#include "src2d/merging/grip.h"
#include "src2d/merging/joint_welds.h"
#include "src2d/merging/rule.h"

namespace merge2d {
namespace {

/// Whether a weld that is not cut joins two members firmly: then the theory need not ask.
bool joinsFirmly(const Collection& c, std::uint32_t number) {
  const Weld& weld = c.welds[number];
  const auto frame = static_cast<std::uint32_t>(c.members.size());
  return weld.grip == Grip::Firm && !weld.cut && !weld.expected && weld.node_a != frame &&
         weld.node_b != frame;
}

/// Per member, and at last for the frame, its node: 0 is the frame; members that are joined firmly
/// share one.
struct Nodes {
  std::vector<std::uint32_t> of;
  std::uint32_t count = 1;
};

Nodes nodesOf(const Collection& c) {
  const auto members = static_cast<std::uint32_t>(c.members.size());
  DisjointSets sets;
  sets.reset(members);
  for (std::uint32_t i = 0; i < c.welds.size(); ++i) {
    if (!joinsFirmly(c, i)) continue;
    sets.unite(c.welds[i].node_a, c.welds[i].node_b);
  }
  Nodes nodes{std::vector<std::uint32_t>(members + 1, 0)};
  for (std::uint32_t m = 0; m < members; ++m) {
    std::uint32_t& node = nodes.of[sets.find(m)];
    if (node == 0) node = nodes.count++;
    nodes.of[m] = node;
  }
  return nodes;
}

/// The contacts of a weld that hold, seen from the first member, and as many pins as its joints
/// count for.
void addPins(const State& state, const Collection& c, const Weld& weld, std::uint32_t a,
             std::uint32_t b, std::vector<Pin>& pins) {
  const Vec2& origin = state[c.members.front()].local;
  forEachHeld(c, weld, [&](const InternalPoint& point) {
    pins.push_back({.a = a, .b = b, .at = point.position - origin, .placed = true});
  });
  if (weld.joints == 0) return;
  const Vec2 at = jointPoint(state, c, weld) - origin;
  for (int i = 0; i < weld.joints; ++i) {
    pins.push_back({.a = a, .b = b, .at = at + i * Vec2::UnitX(), .placed = true});
  }
}

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

Parts partsWithoutCuts(const State& state, const Collection& c) {
  const Nodes nodes = nodesOf(c);
  std::vector<Pin> pins;
  pins.reserve(c.contacts.size());
  for (std::uint32_t i = 0; i < c.welds.size(); ++i) {
    const Weld& weld = c.welds[i];
    const auto a = nodes.of[weld.node_a], b = nodes.of[weld.node_b];
    if (a != b && !weld.cut && !weld.expected) addPins(state, c, weld, a, b, pins);
  }
  const Groups group = heldGroups(nodes.count, pins, state.settings.merging.cycles);

  // Bodies of one rigid group that touch each other, not only the frame, stay one part.
  DisjointSets parts;
  parts.reset(nodes.count);
  for (const Pin& pin : pins) {
    if (pin.a != 0 && pin.b != 0 && group[pin.a] == group[pin.b]) parts.unite(pin.a, pin.b);
  }
  const auto nodeOf = [&](std::uint32_t member) { return nodes.of[member]; };
  const auto held = [&](std::uint32_t node) { return group[node] == group[0]; };
  uniteOnFloors(state, c, nodeOf, held, parts);
  return numbered(c, nodeOf, held, nodes.count, parts);
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
