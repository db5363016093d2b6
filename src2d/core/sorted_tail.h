#pragma once
/// Vectors that are in order, but for elements that were added at their end.

#include <algorithm>
#include <functional>
#include <vector>

namespace merge2d {

/// Brings the end into order, too.
template <class T, class Less = std::less<T>>
void sortTail(std::vector<T>& v, Less less = {}) {
  const auto tail = std::is_sorted_until(v.begin(), v.end(), less);
  std::sort(tail, v.end(), less);
  std::inplace_merge(v.begin(), tail, v.end(), less);
}

}  // namespace merge2d
