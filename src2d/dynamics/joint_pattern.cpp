#include "src2d/dynamics/joint_pattern.h"

#include <algorithm>
#include <iterator>
#include <set>

namespace merge2d {
namespace {

/// A joint that shares bodies with more joints than this would make the matrix dense.
constexpr std::size_t kMostNeighbours = 32;

using Neighbours = std::vector<std::uint32_t>;  ///< ascending

/// Which joints share a body with each joint; those that come late to a crowded body with none.
class JointGraph {
 public:
  explicit JointGraph(const std::vector<JointEnds>& ends) : near_(ends.size()), out_(ends.size()) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> at;  // body, joint
    for (std::uint32_t j = 0; j < ends.size(); ++j) {
      for (const std::uint32_t body : {ends[j].first, ends[j].second}) {
        if (body != kFixedEnd) at.emplace_back(body, j);
      }
    }
    std::ranges::sort(at);
    for (std::size_t i = 0; i < at.size();) {
      std::size_t end = i;
      while (end < at.size() && at[end].first == at[i].first) ++end;
      connect(at, i, end);
      i = end;
    }
    for (std::uint32_t j = 0; j < near_.size(); ++j) {
      if (out_[j] != 0) near_[j].clear();
      std::erase_if(near_[j], [&](std::uint32_t other) { return out_[other] != 0; });
      std::ranges::sort(near_[j]);
      near_[j].erase(std::unique(near_[j].begin(), near_[j].end()), near_[j].end());
      if (out_[j] == 0) waiting_.emplace(near_[j].size(), j);
    }
  }

  bool done() const { return waiting_.empty(); }

  /// The joint with the fewest neighbours, which become each other's.
  std::pair<std::uint32_t, Neighbours> eliminate() {
    const std::uint32_t j = waiting_.begin()->second;
    waiting_.erase(waiting_.begin());
    const Neighbours neighbours = near_[j];
    const bool crowded = neighbours.size() > kMostNeighbours;
    for (const std::uint32_t other : neighbours) {
      waiting_.erase({near_[other].size(), other});
      if (!crowded) unite(near_[other], neighbours);
      std::erase_if(near_[other], [&](std::uint32_t x) { return x == j || x == other; });
      waiting_.emplace(near_[other].size(), other);
    }
    if (crowded) out_[j] = 1;
    return {j, neighbours};
  }

  bool leftOut(std::uint32_t joint) const { return out_[joint] != 0; }

 private:
  void connect(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& at, std::size_t begin,
               std::size_t end) {
    const std::size_t served = std::min(end, begin + kMostNeighbours);
    for (std::size_t i = served; i < end; ++i) out_[at[i].second] = 1;
    for (std::size_t i = begin; i < served; ++i) {
      for (std::size_t k = begin; k < served; ++k) {
        if (at[i].second != at[k].second) near_[at[i].second].push_back(at[k].second);
      }
    }
  }

  static void unite(Neighbours& into, const Neighbours& more) {
    Neighbours all;
    std::set_union(into.begin(), into.end(), more.begin(), more.end(), std::back_inserter(all));
    into = std::move(all);
  }

  std::vector<Neighbours> near_;
  std::vector<std::uint8_t> out_;
  std::set<std::pair<std::size_t, std::uint32_t>> waiting_;  ///< by degree
};

}  // namespace

JointPattern eliminationPattern(std::vector<JointEnds> ends) {
  JointPattern pattern;
  pattern.ends = std::move(ends);
  JointGraph graph(pattern.ends);
  std::vector<std::uint32_t> place(pattern.ends.size(), 0);  // of a joint among the columns
  std::vector<Neighbours> columns;
  while (!graph.done()) {
    auto [joint, neighbours] = graph.eliminate();
    if (graph.leftOut(joint)) continue;
    place[joint] = static_cast<std::uint32_t>(pattern.order.size());
    pattern.order.push_back(joint);
    columns.push_back(std::move(neighbours));
  }
  for (std::uint32_t j = 0; j < pattern.ends.size(); ++j) {
    if (graph.leftOut(j)) pattern.left_out.push_back(j);
  }
  // Some neighbours were left out after the column was made.
  pattern.first.push_back(0);
  for (const Neighbours& column : columns) {
    const auto begin = static_cast<std::ptrdiff_t>(pattern.rows.size());
    for (const std::uint32_t joint : column) {
      if (!graph.leftOut(joint)) pattern.rows.push_back(place[joint]);
    }
    std::sort(pattern.rows.begin() + begin, pattern.rows.end());
    pattern.first.push_back(static_cast<std::uint32_t>(pattern.rows.size()));
  }
  return pattern;
}

}  // namespace merge2d
