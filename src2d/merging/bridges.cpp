#include "src2d/merging/bridges.h"

#include <algorithm>

namespace merge2d {
namespace {

/// Depth first from the frame, then from any member that it did not reach: an edge is a bridge when
/// no other edge leads from beyond it to where the walk came from (Tarjan 1974).
class BridgeSearch {
 public:
  explicit BridgeSearch(Collection& c) : c_(c), next_(c.weld_at.begin(), c.weld_at.end() - 1) {
    visited_.assign(nodes(), 0);
    lowest_.assign(nodes(), 0);
    came_by_.assign(nodes(), kNone);
  }

  void run() {
    for (std::uint32_t n = nodes(); n-- > 0;) {
      if (!visited_[n]) walkFrom(n);
    }
  }

 private:
  static constexpr std::uint32_t kNone = ~0u;

  std::uint32_t nodes() const { return static_cast<std::uint32_t>(c_.members.size() + 1); }

  void visit(std::uint32_t node, std::uint32_t weld) {
    visited_[node] = lowest_[node] = ++count_;
    came_by_[node] = weld;
    path_.push_back(node);
  }

  void walkFrom(std::uint32_t root) {
    visit(root, kNone);
    while (!path_.empty()) {
      const std::uint32_t node = path_.back();
      if (next_[node] < c_.weld_at[node + 1]) {
        follow(node, c_.weld_of[next_[node]++]);
      } else {
        path_.pop_back();
        if (!path_.empty()) leave(node, path_.back());
      }
    }
  }

  void follow(std::uint32_t node, std::uint32_t weld) {
    if (weld == came_by_[node]) return;
    const std::uint32_t a = c_.welds[weld].node_a, b = c_.welds[weld].node_b;
    const std::uint32_t other = a == node ? b : a;
    if (!visited_[other]) return visit(other, weld);
    lowest_[node] = std::min(lowest_[node], visited_[other]);
  }

  void leave(std::uint32_t node, std::uint32_t parent) {
    c_.welds[came_by_[node]].bridge = lowest_[node] > visited_[parent];
    lowest_[parent] = std::min(lowest_[parent], lowest_[node]);
  }

  Collection& c_;
  std::vector<std::uint32_t> next_;     ///< per node: the weld to follow next, in weld_of
  std::vector<std::uint32_t> visited_;  ///< per node: when, from 1 on
  std::vector<std::uint32_t> lowest_;   ///< the earliest that is reached from beyond
  std::vector<std::uint32_t> came_by_;  ///< per node: a weld
  std::vector<std::uint32_t> path_;
  std::uint32_t count_ = 0;
};

}  // namespace

void markBridges(Collection& collection) {
  for (Weld& weld : collection.welds) weld.bridge = false;
  BridgeSearch(collection).run();
}

}  // namespace merge2d
