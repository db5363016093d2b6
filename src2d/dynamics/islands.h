#pragma once
/// Islands: rigid things that touch, directly or through others, but not through what is fixed.

#include <cstdint>
#include <numeric>
#include <vector>

#include "src2d/core/memory.h"

namespace merge2d {

/// Disjoint sets of the numbers 0 … n−1; a set is named by its smallest member.
class DisjointSets {
 public:
  void reset(std::size_t n) {
    parent_.resize(n);
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  std::size_t memoryBytes() const { return bytesOf(parent_); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  /// True when they were apart.
  bool unite(std::uint32_t i, std::uint32_t j) {
    i = find(i);
    j = find(j);
    if (i == j) return false;
    if (j < i) std::swap(i, j);
    parent_[j] = i;
    return true;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace merge2d
