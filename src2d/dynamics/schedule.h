#pragma once
/// The order in which the timed parts of a scene begin: a step looks neither at those that have
/// begun long ago nor at those that wait.

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace merge2d {

/// It follows from the parts, and is made where it is needed first; no saved state holds it.
class Schedule {
 public:
  /// The numbers of the parts that have begun since the last call, ascending. Of `count` parts
  /// `timeOf(number)` says when each begins, and `isReached(time)` holds up to now. When there are
  /// more parts than before, all that have begun are named once more.
  template <class TimeOf, class IsReached>
  std::vector<std::uint32_t> begun(std::size_t count, TimeOf&& timeOf, IsReached&& isReached) {
    if (order_.size() != count) arrange(count, timeOf);
    const std::size_t first = next_;
    while (next_ < count && isReached(timeOf(order_[next_]))) ++next_;
    std::vector<std::uint32_t> numbers(order_.begin() + static_cast<std::ptrdiff_t>(first),
                                       order_.begin() + static_cast<std::ptrdiff_t>(next_));
    std::ranges::sort(numbers);
    return numbers;
  }

 private:
  void arrange(std::size_t count, auto& timeOf) {
    order_.resize(count);
    std::iota(order_.begin(), order_.end(), 0U);
    std::ranges::sort(order_, {}, [&](std::uint32_t i) { return std::pair(timeOf(i), i); });
    next_ = 0;
  }

  std::vector<std::uint32_t> order_;  ///< all parts, ascending in time
  std::size_t next_ = 0;              ///< the first that had not begun
};

/// Where a world stands in its timed parts.
struct Timetable {
  Schedule launches, forces;
  std::vector<std::uint32_t> acting;  ///< forces that have begun and are not over, ascending
};

}  // namespace merge2d
