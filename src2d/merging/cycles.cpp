#include "src2d/merging/cycles.h"

#include <algorithm>

#include "src2d/dynamics/islands.h"

namespace merge2d {
namespace {

/// Edges between different groups, one per pair of groups, ascending, with all their contacts.
std::vector<ContactEdge> contract(std::span<const ContactEdge> edges, DisjointSets& groups) {
  std::vector<ContactEdge> contracted;
  for (const ContactEdge& edge : edges) {
    const std::uint32_t a = groups.find(edge.a), b = groups.find(edge.b);
    if (a != b) contracted.push_back({std::min(a, b), std::max(a, b), edge.contacts});
  }
  const auto key = [](const ContactEdge& e) { return (std::uint64_t{e.a} << 32) | e.b; };
  std::sort(contracted.begin(), contracted.end(),
            [&](const ContactEdge& x, const ContactEdge& y) { return key(x) < key(y); });
  std::size_t kept = 0;
  for (const ContactEdge& edge : contracted) {
    if (kept > 0 && key(contracted[kept - 1]) == key(edge)) {
      contracted[kept - 1].contacts += edge.contacts;
    } else {
      contracted[kept++] = edge;
    }
  }
  contracted.resize(kept);
  return contracted;
}

bool uniteDoubled(std::span<const ContactEdge> edges, DisjointSets& groups) {
  bool changed = false;
  for (const ContactEdge& edge : edges) {
    if (edge.contacts >= 2) changed |= groups.unite(edge.a, edge.b);
  }
  return changed;
}

/// Joins every cycle of three; `edges` ascending, at most one per pair.
bool uniteTriangles(std::uint32_t nodes, std::span<const ContactEdge> edges, DisjointSets& groups) {
  // Neighbours with a larger number, per node: a cycle is then found once, from its smallest node.
  std::vector<std::uint32_t> first(nodes + 1, 0);
  for (const ContactEdge& edge : edges) ++first[edge.a + 1];
  for (std::uint32_t i = 0; i < nodes; ++i) first[i + 1] += first[i];
  const auto neighbours = [&](std::uint32_t node) {
    return edges.subspan(first[node], first[node + 1] - first[node]);
  };
  bool changed = false;
  for (const ContactEdge& edge : edges) {
    const auto of_a = neighbours(edge.a), of_b = neighbours(edge.b);
    std::size_t i = 0, j = 0;
    while (i < of_a.size() && j < of_b.size()) {
      if (of_a[i].b < of_b[j].b) {
        ++i;
      } else if (of_b[j].b < of_a[i].b) {
        ++j;
      } else {
        changed |= groups.unite(edge.a, edge.b);
        changed |= groups.unite(edge.a, of_a[i].b);
        ++i, ++j;
      }
    }
  }
  return changed;
}

}  // namespace

std::vector<std::uint32_t> rigidGroups(std::uint32_t nodes, std::span<const ContactEdge> edges,
                                       CycleCriterion criterion) {
  DisjointSets groups;
  groups.reset(nodes);
  if (criterion == CycleCriterion::Off) {
    for (const ContactEdge& edge : edges) groups.unite(edge.a, edge.b);
  } else {
    bool changed = true;
    while (changed) {
      const auto contracted = contract(edges, groups);
      changed = uniteDoubled(contracted, groups);
      if (!changed) changed = uniteTriangles(nodes, contracted, groups);
    }
  }
  std::vector<std::uint32_t> group(nodes);
  for (std::uint32_t i = 0; i < nodes; ++i) group[i] = groups.find(i);
  return group;
}

}  // namespace merge2d
