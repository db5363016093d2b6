#pragma once
/// Contacts as pins. In the plane a contact point that sticks holds two bodies together at one
/// point, around which they can still turn. docs/cycles.md states what follows from that.

#include <cstdint>
#include <vector>

#include "src2d/core/ids.h"
#include "src2d/core/vec.h"

namespace merge2d {

/// A contact point between the nodes `a` and `b`, which are bodies, or groups that are one body.
struct Pin {
  std::uint32_t a = 0, b = 0;
  Vec2 at = Vec2::Zero();  ///< in a frame common to all pins [m]
  bool placed = false;     ///< `at` is known; otherwise it is somewhere, in general position
};

/// Per node the smallest node of its group; a node on its own is its own group.
using Groups = std::vector<std::uint32_t>;

/// Names the groups of `nodes` nodes, where `find(i)` is one number for all nodes of a group.
template <class Find>
Groups namedGroups(std::uint32_t nodes, Find&& find) {
  Groups smallest(nodes, kNone), groups(nodes);
  for (std::uint32_t i = 0; i < nodes; ++i) {
    std::uint32_t& first = smallest[find(i)];
    if (first == kNone) first = i;
    groups[i] = first;
  }
  return groups;
}

}  // namespace merge2d
