#pragma once
/// ContactOrdering (Section 6.2): the sweep starts at the seeds and walks the contact graph from
/// there, breadth first from all of them at once.

#include <cstdint>
#include <span>
#include <vector>

#include "src2d/dynamics/scratch.h"

namespace merge2d {

/// An edge of the contact graph.
struct GraphEdge {
  std::uint32_t a = 0, b = 0;
};

/// The edges in breadth-first order from the seed nodes: first those at a seed, in the order given,
/// then those at the nodes reached by these, and so on; the rest in the order given. Each index of
/// `edges` appears once. `depth`, when given, gets per edge how many edges it is away from the
/// nearest seed: 1 at a seed, 0 where the walk does not go.
std::vector<std::uint32_t> breadthFirst(std::uint32_t nodes, std::span<const GraphEdge> edges,
                                        std::span<const std::uint32_t> seeds,
                                        std::vector<std::uint32_t>* depth = nullptr);

/// The items in breadth-first order from `scratch.seeds`; the order is noted when somebody asks.
std::vector<SweepItem> orderedFromSeeds(const std::vector<SweepItem>& items,
                                        const Scratch& scratch);

}  // namespace merge2d
