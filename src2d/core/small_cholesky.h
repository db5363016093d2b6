#pragma once
/// Small symmetric systems, in plain loops: Eigen's dense factorisations sum in the order of the
/// processor's vectors, so that their last digits differ between x86 and WebAssembly.

#include <array>
#include <cstddef>

namespace merge2d {

/// Solves A x = b for the first `n` unknowns by A = L D Lᵀ. A must be positive semidefinite; an
/// unknown whose pivot is lost in rounding is 0.
template <std::size_t N>
std::array<double, N> solveSymmetric(std::array<std::array<double, N>, N> a,
                                     const std::array<double, N>& b, std::size_t n) {
  constexpr double kRounding = 1e-15;
  std::array<double, N> inverse{}, x{};
  for (std::size_t j = 0; j < n; ++j) {
    double pivot = a[j][j];
    for (std::size_t k = 0; k < j; ++k) pivot -= a[j][k] * a[j][k] * a[k][k];
    inverse[j] = pivot > kRounding * a[j][j] ? 1.0 / pivot : 0.0;
    a[j][j] = inverse[j] > 0.0 ? pivot : 0.0;
    for (std::size_t i = j + 1; i < n; ++i) {
      double sum = a[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= a[i][k] * a[j][k] * a[k][k];
      a[i][j] = sum * inverse[j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = b[i];
    for (std::size_t k = 0; k < i; ++k) x[i] -= a[i][k] * x[k];
  }
  for (std::size_t i = 0; i < n; ++i) x[i] *= inverse[i];
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) x[i] -= a[k][i] * x[k];
  }
  return x;
}

}  // namespace merge2d
