#pragma once
/// The nodes of a collection's welds: its members, and the frame.

#include <algorithm>
#include <vector>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The place of each body among the members; that of the frame is last.
class Nodes {
 public:
  Nodes(const State& state, const Collection& c) : members_(c.members), node_(memory()) {
    if (node_.size() < state.bodies.size()) node_.resize(state.bodies.size(), kFrame);
    for (std::uint32_t i = 0; i < members_.size(); ++i) node_[index(members_[i])] = i;
  }
  ~Nodes() {
    for (const BodyId b : members_) node_[index(b)] = kFrame;
  }
  Nodes(const Nodes&) = delete;
  Nodes& operator=(const Nodes&) = delete;

  std::uint32_t of(BodyId b) const {
    return std::min(node_[index(b)], static_cast<std::uint32_t>(members_.size()));
  }

 private:
  static constexpr std::uint32_t kFrame = ~0u;
  /// Per body, and kFrame of all between two layouts: small enough to stay in the cache.
  static std::vector<std::uint32_t>& memory() {
    thread_local std::vector<std::uint32_t> node;
    return node;
  }

  const std::vector<BodyId>& members_;
  std::vector<std::uint32_t>& node_;
};

}  // namespace merge2d
