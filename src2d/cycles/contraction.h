#pragma once
/// Contracts a contact graph: two nodes with two contacts become one, three nodes with a contact
/// between each become one, and so on until nothing contracts.
///
/// The result does not depend on the order: what can contract can still do so after anything else
/// has contracted.

#include <array>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "src2d/cycles/pins.h"

namespace merge2d {

/// Three pins that closed a cycle of three nodes, as indices.
using CycleOfThree = std::array<std::uint32_t, 3>;

/// `Rule` says which contacts count: `distinct(p, q)`: two pins of one pair of nodes hold it;
/// `closes(p, q, r)`: the pins of three pairs of three nodes hold these.
template <class Rule>
class Contraction {
 public:
  Contraction(std::uint32_t nodes, std::span<const Pin> pins, const Rule& rule)
      : pins_(pins), rule_(rule), parent_(nodes), links_(nodes) {
    std::iota(parent_.begin(), parent_.end(), 0u);
    for (std::uint32_t i = 0; i < pins.size(); ++i) {
      if (pins[i].a != pins[i].b) link(pins[i].a, pins[i].b, {i, false});
    }
  }

  void run() {
    while (!firm_.empty() || !fresh_.empty()) {
      auto& queue = firm_.empty() ? fresh_ : firm_;
      const bool firm = &queue == &firm_;
      const auto [x, y] = queue.back();
      queue.pop_back();
      const std::uint32_t a = find(x), b = find(y);
      if (a == b) continue;
      if (firm) {
        unite(a, b);
      } else {
        closeTriangle(a, b);
      }
    }
  }

  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  Groups groups() {
    const auto nodes = static_cast<std::uint32_t>(parent_.size());
    return namedGroups(nodes, [this](std::uint32_t i) { return find(i); });
  }

  const std::vector<CycleOfThree>& cycles() const { return cycles_; }

 private:
  /// All pins between two nodes: one of them, and whether there is another that is distinct.
  struct Link {
    std::uint32_t pin = 0;
    bool firm = false;
  };
  using NodePair = std::pair<std::uint32_t, std::uint32_t>;

  /// Adds pins between two nodes to those that are there.
  void link(std::uint32_t a, std::uint32_t b, const Link& more) {
    const auto [at, added] = links_[a].try_emplace(b, more);
    Link& now = at->second;
    now.firm |= more.firm || (!added && rule_.distinct(pins_[now.pin], pins_[more.pin]));
    links_[b][a] = now;
    if (now.firm) {
      firm_.emplace_back(a, b);
    } else if (added) {
      fresh_.emplace_back(a, b);
    }
  }

  /// Looks for a third node that closes a cycle with `a` and `b`, which are linked by one pin.
  void closeTriangle(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t pin = links_[a].at(b).pin;
    if (links_[a].size() > links_[b].size()) std::swap(a, b);
    for (const auto& [c, to_c] : links_[a]) {
      const auto from_b = links_[b].find(c);
      if (from_b == links_[b].end()) continue;
      const CycleOfThree cycle{pin, to_c.pin, from_b->second.pin};
      if (!rule_.closes(pins_[cycle[0]], pins_[cycle[1]], pins_[cycle[2]])) continue;
      cycles_.push_back(cycle);
      const std::uint32_t third = c;
      unite(a, b);
      unite(find(a), find(third));
      return;
    }
  }

  /// The node with fewer links hands them over.
  void unite(std::uint32_t to, std::uint32_t from) {
    if (to == from) return;
    if (links_[to].size() < links_[from].size()) std::swap(to, from);
    parent_[from] = to;
    const auto moved = std::move(links_[from]);
    links_[from].clear();
    for (const auto& [node, pins] : moved) {
      links_[node].erase(from);
      if (node != to) link(to, node, pins);
    }
  }

  std::span<const Pin> pins_;
  Rule rule_;
  std::vector<std::uint32_t> parent_;
  std::vector<std::map<std::uint32_t, Link>> links_;  ///< per node, by neighbour
  std::vector<NodePair> firm_, fresh_;                ///< pairs to contract, and to close
  std::vector<CycleOfThree> cycles_;
};

}  // namespace merge2d
