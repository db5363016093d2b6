#pragma once
/// Which welds of single contacts are stable (Section 8.2). In 2D one contact between two bodies is
/// a pivot; it holds only as part of a group that is rigid as a whole.

#include <cstdint>
#include <span>
#include <vector>

#include "src2d/scene/settings.h"

namespace merge2d {

/// `contacts` points of contact between the nodes `a` and `b`.
struct ContactEdge {
  std::uint32_t a = 0, b = 0;
  int contacts = 0;
};

/// Groups of nodes that hold together: per node the smallest node of its group.
/// `Off`: whatever is connected. `Triangle`: two or more contacts hold, and so does a cycle of
/// exactly three groups with one contact between each; groups count as one node, repeated until
/// nothing joins.
std::vector<std::uint32_t> rigidGroups(std::uint32_t nodes, std::span<const ContactEdge> edges,
                                       CycleCriterion criterion);

}  // namespace merge2d
