#pragma once
/// Disjoint sets of numbers: islands of things that touch, groups of bodies that hold together.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <vector>

#include "src2d/core/memory.h"

namespace merge2d {

/// Sets of the numbers 0 … n−1; a set is named by its smallest member.
class DisjointSets {
 public:
  /// Takes time linear in the number of unions since the last one; that in n is negligible.
  void reset(std::size_t n) {
    for (std::size_t w = 0; w < united_.size(); ++w) {
      for (; united_[w] != 0; united_[w] &= united_[w] - 1) {
        resetRun(kRun * (64 * w + static_cast<std::size_t>(std::countr_zero(united_[w]))));
      }
    }
    const std::size_t before = parent_.size();
    if (n <= before) return;
    parent_.resize(n);
    iota(before, n);
    united_.resize(n / (64 * kRun) + 1, 0);
  }
  std::size_t memoryBytes() const { return bytesOf(parent_, united_); }
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
    const std::size_t run = j / kRun;
    united_[run / 64] |= std::uint64_t{1} << (run % 64);
    return true;
  }

 private:
  static constexpr std::size_t kRun = 64;  ///< numbers that are reset together

  void resetRun(std::size_t first) { iota(first, std::min(first + kRun, parent_.size())); }
  void iota(std::size_t first, std::size_t last) {
    const auto begin = parent_.begin();
    std::iota(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(last),
              static_cast<std::uint32_t>(first));
  }

  std::vector<std::uint32_t> parent_;
  std::vector<std::uint64_t> united_;  ///< bit i: run i has numbers that are not their own parent
};

}  // namespace merge2d
