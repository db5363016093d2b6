#include "src2d/cycles/rigid.h"

#include <algorithm>
#include <numeric>
#include <random>

#include "src2d/cycles/contraction.h"
#include "src2d/cycles/growth.h"
#include "src2d/cycles/motions.h"
#include "src2d/cycles/pebble_game.h"
#include "src2d/cycles/tolerance.h"

namespace merge2d {
namespace {

/// Smallest and largest of the placed pins, and the largest coordinate.
struct Extent {
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
  double largest = 0.0;
};

Extent extentOf(std::span<const Pin> pins) {
  Extent extent;
  bool first = true;
  for (const Pin& pin : pins) {
    if (!pin.placed) continue;
    extent.low = first ? pin.at : Vec2(extent.low.cwiseMin(pin.at));
    extent.high = first ? pin.at : Vec2(extent.high.cwiseMax(pin.at));
    extent.largest = std::max(extent.largest, pin.at.cwiseAbs().maxCoeff());
    first = false;
  }
  return extent;
}

/// Gives the pins of one group that have no place one among the others: any will do, but those on a
/// set of measure zero.
void placeTheRest(std::span<Pin> pins, const Extent& extent) {
  std::mt19937_64 random(1);
  const auto unit = [&] { return static_cast<double>(random() >> 11u) * 0x1p-53; };
  Vec2 span = extent.high - extent.low;
  const double size = span.maxCoeff() > 0.0 ? span.maxCoeff() : 1.0;
  span = span.cwiseMax(0.5 * size);
  for (Pin& pin : pins) {
    if (pin.placed) continue;
    pin.at = extent.low + Vec2(unit() * span.x(), unit() * span.y());
    pin.placed = true;
  }
}

/// Numbers the nodes of `groups` that `pins` mention from 0; `nodes[i]` is what i stands for.
std::vector<std::uint32_t> renumber(std::span<Pin> pins) {
  std::vector<std::uint32_t> nodes;
  for (const Pin& pin : pins) nodes.insert(nodes.end(), {pin.a, pin.b});
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const auto number = [&](std::uint32_t node) {
    const auto at = std::lower_bound(nodes.begin(), nodes.end(), node);
    return static_cast<std::uint32_t>(at - nodes.begin());
  };
  for (Pin& pin : pins) {
    pin.a = number(pin.a);
    pin.b = number(pin.b);
  }
  return nodes;
}

/// Refines one generic group. Pairs and triangles, of bodies and then of groups, settle most of it
/// at their own scale; what remains is looked at as a whole.
Groups placedGroup(std::uint32_t nodes, std::span<const Pin> pins, double resolution) {
  Contraction contraction(nodes, pins, PinRule{resolution});
  contraction.run();
  Groups groups = contraction.groups();
  std::vector<Pin> rest;
  for (Pin pin : pins) {
    pin.a = groups[pin.a];
    pin.b = groups[pin.b];
    if (pin.a != pin.b) rest.push_back(pin);
  }
  if (rest.empty()) return groups;
  const std::vector<std::uint32_t> core = renumber(rest);
  const Groups joined = placedGroups(static_cast<std::uint32_t>(core.size()), rest, resolution);
  Groups of_core(nodes);
  std::iota(of_core.begin(), of_core.end(), 0u);
  for (std::size_t i = 0; i < core.size(); ++i) of_core[core[i]] = core[joined[i]];
  for (std::uint32_t& group : groups) group = of_core[group];
  return groups;
}

}  // namespace

Groups rigidGroups(std::uint32_t nodes, std::span<const Pin> pins) {
  Groups groups = genericGroups(nodes, pins);
  const Extent all = extentOf(pins);

  // The pins inside generic groups, group by group.
  std::vector<Pin> inner;
  for (const Pin& pin : pins) {
    if (pin.a != pin.b && groups[pin.a] == groups[pin.b]) inner.push_back(pin);
  }
  const auto group = [&groups](const Pin& pin) { return groups[pin.a]; };
  std::stable_sort(inner.begin(), inner.end(),
                   [&](const Pin& p, const Pin& q) { return group(p) < group(q); });

  Groups refined = groups;
  for (auto first = inner.begin(); first != inner.end();) {
    const auto last = std::find_if(first, inner.end(),
                                   [&](const Pin& pin) { return group(pin) != group(*first); });
    const std::span<Pin> own(&*first, static_cast<std::size_t>(last - first));
    first = last;
    if (std::none_of(own.begin(), own.end(), [](const Pin& p) { return p.placed; })) continue;
    placeTheRest(own, extentOf(own));
    const std::vector<std::uint32_t> members = renumber(own);
    const Groups placed =
        placedGroup(static_cast<std::uint32_t>(members.size()), own, kPointTolerance * all.largest);
    for (std::size_t i = 0; i < members.size(); ++i) refined[members[i]] = members[placed[i]];
  }
  return refined;
}

}  // namespace merge2d
