#include "src2d/cycles/held_groups.h"

#include <algorithm>

#include "src2d/core/disjoint_sets.h"
#include "src2d/cycles/growth.h"
#include "src2d/cycles/rigid.h"
#include "src2d/cycles/tolerance.h"
#include "src2d/cycles/triangle.h"

namespace merge2d {
namespace {

Groups namedBy(DisjointSets& sets, std::uint32_t nodes) {
  Groups groups(nodes);
  for (std::uint32_t i = 0; i < nodes; ++i) groups[i] = sets.find(i);
  return groups;
}

/// Pins nearer than this are one [m]; where they are does not matter to the triangles.
double resolutionOf(std::span<const Pin> pins, CycleCriterion criterion) {
  if (criterion == CycleCriterion::Triangle) return -1.0;
  double largest = 0.0;
  for (const Pin& pin : pins) largest = std::max(largest, pin.at.cwiseAbs().maxCoeff());
  return kPointTolerance * largest;
}

/// Most pairs in a pile have two contacts and need no theory: joins them at once.
void joinFirmPairs(std::span<const Pin> pins, double resolution, DisjointSets& sets) {
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

Core coreOf(std::uint32_t nodes, std::span<const Pin> pins, DisjointSets& sets) {
  Core core;
  core.pins.reserve(pins.size());
  std::vector<std::uint32_t> number(nodes, kNone);
  const auto numbered = [&](std::uint32_t node) {
    if (number[node] == kNone) {
      number[node] = static_cast<std::uint32_t>(core.nodes.size());
      core.nodes.push_back(node);
    }
    return number[node];
  };
  for (Pin pin : pins) {
    const std::uint32_t a = sets.find(pin.a), b = sets.find(pin.b);
    if (a == b) continue;
    pin.a = numbered(a);
    pin.b = numbered(b);
    core.pins.push_back(pin);
  }
  return core;
}

/// Joins the bodies that hang on the largest group, one after the other.
void joinGrown(const Core& core, double resolution, DisjointSets& sets) {
  const auto inside =
      grownGroup(static_cast<std::uint32_t>(core.nodes.size()), core.pins, {resolution});
  std::uint32_t first = kNone;
  for (std::uint32_t i = 0; i < inside.size(); ++i) {
    if (inside[i] == 0) continue;
    if (first == kNone) first = i;
    sets.unite(core.nodes[first], core.nodes[i]);
  }
}

}  // namespace

Groups heldGroups(std::uint32_t nodes, std::span<const Pin> pins, CycleCriterion criterion) {
  DisjointSets sets;
  sets.reset(nodes);
  if (criterion == CycleCriterion::Off) {
    for (const Pin& pin : pins) sets.unite(pin.a, pin.b);
    return namedBy(sets, nodes);
  }
  const double resolution = resolutionOf(pins, criterion);
  joinFirmPairs(pins, resolution, sets);
  joinGrown(coreOf(nodes, pins, sets), resolution, sets);
  const Core core = coreOf(nodes, pins, sets);
  const auto size = static_cast<std::uint32_t>(core.nodes.size());
  const Groups joined = criterion == CycleCriterion::Triangle
                            ? triangleGroups(size, core.pins).groups
                            : rigidGroups(size, core.pins);
  for (std::uint32_t i = 0; i < size; ++i) sets.unite(core.nodes[i], core.nodes[joined[i]]);
  return namedBy(sets, nodes);
}

}  // namespace merge2d
