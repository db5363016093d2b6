#pragma once
/// Lists of indices, one for each of a row of things, one behind the other in memory.

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace merge2d {

struct IndexRuns {
  /// Per thing the place where its list begins, and the place where the last one ends; then the
  /// lists.
  std::vector<std::uint32_t> numbers;

  bool empty() const { return numbers.empty(); }

  std::span<const std::uint32_t> operator[](std::size_t thing) const {
    return {numbers.data() + numbers[thing], numbers.data() + numbers[thing + 1]};
  }

  /// The lists of `things` things anew. `forEach(visit)` calls `visit(thing, index)` for each entry
  /// in the order in which it shall stand; it is called twice.
  template <class ForEach>
  void build(std::size_t things, ForEach&& forEach) {
    std::vector<std::uint32_t> next(things + 1, 0);
    next[0] = static_cast<std::uint32_t>(things + 1);
    forEach([&](std::size_t thing, std::uint32_t) { ++next[thing + 1]; });
    std::partial_sum(next.begin(), next.end(), next.begin());
    numbers = next;
    numbers.resize(next.back());
    forEach([&](std::size_t thing, std::uint32_t index) { numbers[next[thing]++] = index; });
  }
};

}  // namespace merge2d
