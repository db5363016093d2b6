#pragma once
/// A faster order for many sweeps over the same items.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Puts items next to each other that share no body. Each item goes into the first turn after those
/// of all earlier items that share a body with it. Each body meets its items in the same order as
/// before, so a sweep has the same results to the bit; but the processor need not finish one item
/// before it begins the next.
class Interleaving {
 public:
  static constexpr std::uint32_t kFixed = ~0u;  ///< does not respond to forces, and is shared

  /// `place(body)` is below `bodies`, or kFixed. Valid until the next call.
  template <class Place>
  std::span<const SweepItem> of(std::span<const SweepItem> items, std::size_t bodies,
                                Place&& place) {
    next_.assign(bodies, 0);
    first_.assign(1, 0);
    turn_.clear();
    for (const SweepItem& item : items) {
      turn_.push_back(takeTurn(place(item.a()), place(item.b())));
      if (turn_.back() + 2 > first_.size()) first_.push_back(0);
      ++first_[turn_.back() + 1];
    }
    for (std::size_t t = 1; t < first_.size(); ++t) first_[t] += first_[t - 1];
    items_.assign(items.begin(), items.end());
    for (std::size_t i = 0; i < items.size(); ++i) items_[first_[turn_[i]]++] = items[i];
    return items_;
  }

 private:
  std::uint32_t takeTurn(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t turn = std::max(a == kFixed ? 0 : next_[a], b == kFixed ? 0 : next_[b]);
    for (const std::uint32_t body : {a, b}) {
      if (body != kFixed) next_[body] = turn + 1;
    }
    return turn;
  }

  std::vector<std::uint32_t> next_;   ///< per body: the first turn that it is free in
  std::vector<std::uint32_t> turn_;   ///< per item
  std::vector<std::uint32_t> first_;  ///< per turn: the place of its next item
  std::vector<SweepItem> items_;      ///< in turns
};

}  // namespace merge2d
