#include "src2d/merging/ordering.h"

#include <algorithm>

namespace merge2d {

std::vector<std::uint32_t> breadthFirst(std::uint32_t nodes, std::span<const GraphEdge> edges,
                                        std::span<const std::uint32_t> seeds,
                                        std::vector<std::uint32_t>* depth) {
  // Edges at each node, in the order given.
  std::vector<std::uint32_t> first(nodes + 1, 0);
  for (const GraphEdge& e : edges) ++first[e.a + 1], ++first[e.b + 1];
  for (std::uint32_t n = 0; n < nodes; ++n) first[n + 1] += first[n];
  std::vector<std::uint32_t> at(first.begin(), first.end() - 1), incident(first.back());
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    incident[at[edges[i].a]++] = i;
    incident[at[edges[i].b]++] = i;
  }

  // The walk.
  std::vector<std::uint32_t> reached(nodes, 0);  // 1 + edges from the nearest seed
  std::vector<std::uint8_t> placed(edges.size(), 0);
  if (depth) depth->assign(edges.size(), 0);
  std::vector<std::uint32_t> queue, order;
  order.reserve(edges.size());
  const auto reach = [&](std::uint32_t node, std::uint32_t distance) {
    if (reached[node]) return;
    reached[node] = distance + 1;
    queue.push_back(node);
  };
  for (const std::uint32_t seed : seeds) reach(seed, 0);
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const std::uint32_t node = queue[head];
    for (std::uint32_t i = first[node]; i < first[node + 1]; ++i) {
      const std::uint32_t edge = incident[i];
      if (placed[edge]) continue;
      placed[edge] = 1;
      order.push_back(edge);
      if (depth) (*depth)[edge] = reached[node];
      reach(edges[edge].a == node ? edges[edge].b : edges[edge].a, reached[node]);
    }
  }

  // Items that the walk does not reach.
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    if (!placed[i]) order.push_back(i);
  }
  return order;
}

std::vector<SweepItem> orderedFromSeeds(const std::vector<SweepItem>& items,
                                        const Scratch& scratch) {
  std::vector<GraphEdge> edges;
  edges.reserve(items.size());
  for (const SweepItem& item : items) edges.push_back({item.a(), item.b()});
  std::vector<std::uint32_t> depth;
  const auto nodes = static_cast<std::uint32_t>(scratch.sweep_u.size()), world = nodes - 1;
  const auto order = breadthFirst(nodes, edges, scratch.seeds, scratch.notes ? &depth : nullptr);
  std::vector<SweepItem> ordered;
  ordered.reserve(order.size());
  for (const std::uint32_t i : order) {
    ordered.push_back(items[i]);
    if (!scratch.notes || std::max(edges[i].a, edges[i].b) >= world) continue;
    scratch.notes->order.push_back(
        {BodyId{edges[i].a}, BodyId{edges[i].b}, static_cast<int>(depth[i])});
  }
  return ordered;
}

}  // namespace merge2d
