#pragma once
/// Small matrices of the rows of joints, inverted with the strongest rows first.

#include <array>
#include <cstddef>

namespace merge2d {

/// Three rows of one joint against three of another; a joint with fewer has rows of zeros.
using JointMatrix = std::array<std::array<double, 3>, 3>;
using JointVector = std::array<double, 3>;

/// A pivot below this part of its row's own K says nothing new, and the row then gets the other
/// part of K as softness. A pivot p leaves rounding of 1e-16 / p to those after it, which must tell
/// nothing from something still.
inline constexpr double kDependent = 1e-7, kSoftened = 1e-4;

/// Exchanges x and y of row i in y = K x, for a matrix of n rows. After all rows K is its inverse.
template <class At>
void exchangeRow(At&& k, std::size_t n, std::size_t i) {
  const double pivot = 1.0 / k(i, i);
  for (std::size_t r = 0; r < n; ++r) {
    if (r == i) continue;
    const double l = k(r, i) * pivot;
    for (std::size_t s = 0; s < n; ++s) {
      if (s != i) k(r, s) -= l * k(i, s);
    }
    k(r, i) = l;
  }
  for (std::size_t s = 0; s < n; ++s) {
    if (s != i) k(i, s) *= -pivot;
  }
  k(i, i) = pivot;
}

/// Of n rows that are not done, the one with the most left of its own K.
template <class Left, class Done>
std::size_t strongestRow(std::size_t n, Left&& left, Done&& done) {
  std::size_t best = n;
  for (std::size_t i = 0; i < n; ++i) {
    if (!done(i) && (best == n || left(i) > left(best))) best = i;
  }
  return best;
}

}  // namespace merge2d
