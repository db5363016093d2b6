#include <algorithm>

#include "src2d/cycles/contact_graph.h"
#include "src2d/cycles/pebble_game.h"
#include "src2d/cycles/rigid.h"
#include "src2d/cycles/triangle.h"

namespace merge2d {

std::vector<std::vector<std::uint32_t>> membersOf(const Groups& groups) {
  std::vector<std::vector<std::uint32_t>> members(groups.size());
  for (std::uint32_t i = 0; i < groups.size(); ++i) members[groups[i]].push_back(i);
  std::erase_if(members, [](const auto& group) { return group.size() < 2; });
  return members;
}

namespace {

/// The node of each body: all that are pinned are the first of them.
std::vector<std::uint32_t> nodesOf(const ContactGraph& graph) {
  const auto ground = static_cast<std::uint32_t>(
      std::find(graph.pinned.begin(), graph.pinned.end(), 1) - graph.pinned.begin());
  std::vector<std::uint32_t> nodes(graph.bodies.size());
  for (std::uint32_t i = 0; i < nodes.size(); ++i) nodes[i] = graph.pinned[i] != 0 ? ground : i;
  return nodes;
}

/// The pins of all pairs, and the pair of each. Two are as firm as any larger number that nobody
/// has placed.
struct PinsOfPairs {
  std::vector<Pin> pins;
  std::vector<std::uint32_t> pair_of;

  PinsOfPairs(const ContactGraph& graph, const std::vector<std::uint32_t>& nodes) {
    for (std::uint32_t i = 0; i < graph.pairs.size(); ++i) {
      const GraphPair& pair = graph.pairs[i];
      Pin pin{.a = nodes[pair.a], .b = nodes[pair.b]};
      pin.placed = !pair.points.empty();
      const auto count =
          pin.placed ? pair.points.size() : static_cast<std::size_t>(std::min(pair.contacts, 2));
      for (std::size_t k = 0; k < count; ++k) {
        if (pin.placed) pin.at = pair.points[k];
        pins.push_back(pin);
        pair_of.push_back(i);
      }
    }
  }
};

}  // namespace

CycleVerdicts judge(const ContactGraph& graph) {
  const auto bodies = static_cast<std::uint32_t>(graph.bodies.size());
  const std::vector<std::uint32_t> nodes = nodesOf(graph);
  const auto& [pins, pair_of] = PinsOfPairs(graph, nodes);

  CycleVerdicts verdicts;
  const auto of_bodies = [&](const Groups& of_nodes) {
    Groups groups(bodies);
    for (std::uint32_t i = 0; i < bodies; ++i) groups[i] = of_nodes[nodes[i]];
    return groups;
  };
  const TriangleGroups triangle = triangleGroups(bodies, pins);
  verdicts.triangle = of_bodies(triangle.groups);
  verdicts.generic = of_bodies(genericGroups(bodies, pins));
  verdicts.rigid = of_bodies(rigidGroups(bodies, pins));
  for (const CycleOfThree& cycle : triangle.cycles) {
    verdicts.cycles.push_back({pair_of[cycle[0]], pair_of[cycle[1]], pair_of[cycle[2]]});
  }
  for (const GraphPair& pair : graph.pairs) {
    const auto may_merge = [&](const Groups& groups) {
      return static_cast<std::uint8_t>(pair.contacts > 0 && groups[pair.a] == groups[pair.b]);
    };
    verdicts.pair_triangle.push_back(may_merge(verdicts.triangle));
    verdicts.pair_rigid.push_back(may_merge(verdicts.rigid));
  }
  return verdicts;
}

}  // namespace merge2d
