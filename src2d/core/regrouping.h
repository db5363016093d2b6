#pragma once
/// The elements of a vector in a new order, between new ones.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "src2d/core/memory.h"

namespace merge2d {

/// Moves runs of elements within the vector where those that stay keep their order, as most do when
/// a few come or go; a table of a large collection is not copied then.
class Regrouping {
 public:
  static constexpr std::uint32_t kNew = ~0u;

  /// Per new place the one that its element had before, or kNew.
  explicit Regrouping(std::vector<std::uint32_t> from) : from_(std::move(from)) {
    std::uint32_t next = 0;  // after those that have been seen
    for (std::uint32_t to = 0; to < from_.size(); ++to) {
      const std::uint32_t at = from_[to];
      if (at == kNew) continue;
      in_order_ &= at >= next;
      next = at + 1;
      if (!runs_.empty() && at == runs_.back().from + runs_.back().count &&
          to == runs_.back().to + runs_.back().count) {
        ++runs_.back().count;
      } else {
        runs_.push_back({at, to, 1});
      }
    }
  }

  std::span<const std::uint32_t> from() const { return from_; }

  /// New places hold anything afterwards.
  template <class T>
  void apply(std::vector<T>& v) const {
    if (in_order_) {
      moveInPlace(v);
    } else {
      copy(v);
    }
  }

 private:
  struct Run {
    std::uint32_t from = 0, to = 0, count = 0;
  };

  /// Those that move to the front first, from the front on, and then the others, from the end on:
  /// none lands on one that has not moved yet.
  template <class T>
  void moveInPlace(std::vector<T>& v) const {
    if (v.size() < from_.size()) resizeTightly(v, from_.size());
    for (const Run& run : runs_) {
      if (run.to < run.from) std::copy_n(v.begin() + run.from, run.count, v.begin() + run.to);
    }
    for (std::size_t i = runs_.size(); i-- > 0;) {
      const Run& run = runs_[i];
      if (run.to <= run.from) continue;
      const auto first = v.begin() + run.from;
      std::copy_backward(first, first + run.count, v.begin() + run.to + run.count);
    }
    v.resize(from_.size());
  }

  template <class T>
  void copy(std::vector<T>& v) const {
    std::vector<T> moved;
    resizeTightly(moved, from_.size());
    for (std::size_t to = 0; to < from_.size(); ++to) {
      if (from_[to] != kNew) moved[to] = v[from_[to]];
    }
    v = std::move(moved);
  }

  std::vector<std::uint32_t> from_;
  std::vector<Run> runs_;
  bool in_order_ = true;
};

}  // namespace merge2d
