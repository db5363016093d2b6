#include "src2d/merging/cycles.h"

#include <algorithm>

#include "src2d/cycles/rigid.h"
#include "src2d/cycles/tolerance.h"
#include "src2d/cycles/triangle.h"
#include "src2d/dynamics/islands.h"

namespace merge2d {
namespace {

Groups namedBy(DisjointSets& sets, std::uint32_t nodes) {
  Groups groups(nodes);
  for (std::uint32_t i = 0; i < nodes; ++i) groups[i] = sets.find(i);
  return groups;
}

/// Most pairs in a pile have two contacts and need no theory: joins them at once.
void joinFirmPairs(std::span<const Pin> pins, CycleCriterion criterion, DisjointSets& sets) {
  double largest = 0.0;
  for (const Pin& pin : pins) largest = std::max(largest, pin.at.cwiseAbs().maxCoeff());
  const double resolution = criterion == CycleCriterion::Rigid ? kPointTolerance * largest : -1.0;
  for (std::size_t i = 1; i < pins.size(); ++i) {
    const Pin &p = pins[i - 1], &q = pins[i];
    const bool one_pair = p.a == q.a && p.b == q.b;
    if (one_pair && (p.at - q.at).norm() > resolution) sets.unite(p.a, p.b);
  }
}

/// The pins between different sets, with the nodes that they mention numbered from 0.
struct Core {
  std::vector<std::uint32_t> nodes;
  std::vector<Pin> pins;
};

Core coreOf(std::span<const Pin> pins, DisjointSets& sets) {
  Core core;
  for (Pin pin : pins) {
    pin.a = sets.find(pin.a);
    pin.b = sets.find(pin.b);
    if (pin.a == pin.b) continue;
    core.pins.push_back(pin);
    core.nodes.insert(core.nodes.end(), {pin.a, pin.b});
  }
  std::sort(core.nodes.begin(), core.nodes.end());
  core.nodes.erase(std::unique(core.nodes.begin(), core.nodes.end()), core.nodes.end());
  const auto number = [&](std::uint32_t node) {
    const auto at = std::lower_bound(core.nodes.begin(), core.nodes.end(), node);
    return static_cast<std::uint32_t>(at - core.nodes.begin());
  };
  for (Pin& pin : core.pins) {
    pin.a = number(pin.a);
    pin.b = number(pin.b);
  }
  return core;
}

}  // namespace

Groups heldGroups(std::uint32_t nodes, std::span<const Pin> pins, CycleCriterion criterion) {
  DisjointSets sets;
  sets.reset(nodes);
  if (criterion == CycleCriterion::Off) {
    for (const Pin& pin : pins) sets.unite(pin.a, pin.b);
    return namedBy(sets, nodes);
  }
  joinFirmPairs(pins, criterion, sets);
  const Core core = coreOf(pins, sets);
  const auto size = static_cast<std::uint32_t>(core.nodes.size());
  const Groups joined = criterion == CycleCriterion::Triangle
                            ? triangleGroups(size, core.pins).groups
                            : rigidGroups(size, core.pins);
  for (std::uint32_t i = 0; i < size; ++i) sets.unite(core.nodes[i], core.nodes[joined[i]]);
  return namedBy(sets, nodes);
}

}  // namespace merge2d
