#pragma once
/// Memory that is kept between steps, without the slack of doubling.

#include <cstddef>
#include <vector>

namespace merge2d {

/// Makes room for `n` elements, and an eighth more when it has to grow.
template <class T>
void reserveTightly(std::vector<T>& v, std::size_t n) {
  if (v.capacity() < n) v.reserve(n + n / 8);
}

/// Gives memory back that is mostly unused.
template <class T>
void trim(std::vector<T>& v) {
  if (v.size() < v.capacity() / 2) v.shrink_to_fit();
}

}  // namespace merge2d
