#include "src2d/merging/parts.h"

#include <algorithm>

#include "src2d/merging/collection.h"
#include "src2d/merging/cycles.h"
#include "src2d/merging/detours.h"
#include "src2d/merging/joint_welds.h"
#include "src2d/merging/unmerge.h"

namespace merge2d {
namespace {

/// Per body its node: the members from 1 on, 0 for the frame.
std::vector<std::uint32_t> nodesOf(const State& state, const Collection& c) {
  std::vector<std::uint32_t> node(state.bodies.size(), 0);
  for (std::uint32_t i = 0; i < c.members.size(); ++i) node[index(c.members[i])] = i + 1;
  return node;
}

/// The contacts of a weld that hold, seen from the first member, and what its joints are worth.
void addPins(const State& state, const Collection& c, const Weld& weld, std::uint32_t a,
             std::uint32_t b, std::vector<Pin>& pins) {
  const Vec2& origin = state[c.members.front()].local;
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    const InternalContact& inner = c.contacts[i];
    for (std::size_t p = 0; p < static_cast<std::size_t>(inner.count); ++p) {
      if (!inner.points[p].active || inner.points[p].lost) continue;
      pins.push_back({.a = a, .b = b, .at = inner.points[p].position - origin, .placed = true});
    }
  }
  if (weld.joints == 0) return;
  const Vec2 at = jointPoint(state, c, weld) - origin;
  for (int i = 0; i < weld.joints; ++i) {
    pins.push_back({.a = a, .b = b, .at = at + i * Vec2::UnitX(), .placed = true});
  }
}

}  // namespace

bool holdsFirmly(const State& state, const Collection& c) {
  thread_local DisjointSets sets;  // its memory is kept
  sets.reset(c.members.size());
  const double resolution = resolutionOf(state, c);
  std::size_t sets_left = c.members.size();
  bool anchored = false;
  for (const Weld& weld : c.welds) {
    if (weld.cut || weld.expected || !isFirm(c, weld, resolution)) continue;
    const bool a_in = state[weld.a].rigid == c.rigid, b_in = state[weld.b].rigid == c.rigid;
    anchored |= !(a_in && b_in);
    if (!(a_in && b_in)) continue;
    const auto a = state[rigidOf(weld.a)].member;
    const auto b = state[rigidOf(weld.b)].member;
    if (sets.find(a) == sets.find(b)) continue;
    sets.unite(a, b);
    --sets_left;
  }
  return sets_left == 1 && anchored != state[c.rigid].floating();
}

Parts partsWithoutCuts(const State& state, const Collection& c) {
  const std::vector<std::uint32_t> node = nodesOf(state, c);
  std::vector<Pin> pins;
  pins.reserve(2 * c.welds.size());
  for (const Weld& weld : c.welds) {
    if (!weld.cut && !weld.expected)
      addPins(state, c, weld, node[index(weld.a)], node[index(weld.b)], pins);
  }
  const auto nodes = static_cast<std::uint32_t>(c.members.size() + 1);
  const CycleCriterion criterion = state.settings.unmerging.rule == Rule::Paper
                                       ? CycleCriterion::Off
                                       : state.settings.merging.cycles;
  const Groups group = heldGroups(nodes, pins, criterion);

  // Bodies of one rigid group that touch each other, not only the frame, stay one part.
  DisjointSets parts;
  parts.reset(nodes);
  for (const Pin& pin : pins) {
    if (pin.a != 0 && pin.b != 0 && group[pin.a] == group[pin.b]) parts.unite(pin.a, pin.b);
  }
  Parts result;
  std::vector<std::uint32_t> number(nodes, ~0u);
  for (std::uint32_t n = 1; n < nodes; ++n) {
    std::uint32_t& p = number[parts.find(n)];
    if (p == ~0u) {
      p = static_cast<std::uint32_t>(result.anchored.size());
      result.anchored.push_back(0);
    }
    result.part.push_back(p);
    if (group[n] == group[0]) result.anchored[p] = 1;
  }
  return result;
}

bool fallsApart(const State& state, const Collection& c, const Parts& parts) {
  return parts.anchored.size() > 1 || (parts.anchored[0] != 0) != !state[c.rigid].floating();
}

}  // namespace merge2d
