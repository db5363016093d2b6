#pragma once
/// Memory that is kept between steps, without the slack of doubling.

#include <cstddef>
#include <vector>

namespace merge2d {

/// Makes room for `n` elements, and a sixty-fourth more when it has to grow.
template <class T>
void reserveTightly(std::vector<T>& v, std::size_t n) {
  if (v.capacity() < n) v.reserve(n + n / 64);
}

/// Brings it to `n` elements, likewise; new ones are `value`.
template <class T>
void resizeTightly(std::vector<T>& v, std::size_t n, const T& value = {}) {
  reserveTightly(v, n);
  v.resize(n, value);
}

/// One more element at the end, likewise.
template <class T>
void appendTightly(std::vector<T>& v) {
  reserveTightly(v, v.size() + 1);
  v.emplace_back();
}

/// Memory of several vectors [bytes].
template <class... T>
std::size_t bytesOf(const std::vector<T>&... v) {
  return (std::size_t{0} + ... + (v.capacity() * sizeof(T)));
}

/// Gives back what is more than a sixteenth of what is used.
template <class... T>
void tighten(std::vector<T>&... v) {
  (..., (v.capacity() - v.size() > v.size() / 16 ? v.shrink_to_fit() : void()));
}

/// Gives memory back that is mostly unused.
template <class... T>
void trim(std::vector<T>&... v) {
  (..., (v.size() < v.capacity() / 2 ? v.shrink_to_fit() : void()));
}

}  // namespace merge2d
