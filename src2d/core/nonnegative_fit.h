#pragma once
/// Non-negative least squares over a few vectors that are known by their products.
/// Source: Lawson, Hanson 1974.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "src2d/core/small_cholesky.h"

namespace merge2d {

/// One fit of at most N vectors, from a set of free weights that grows and shrinks.
template <std::size_t N>
class NonNegativeFit {
 public:
  using Weights = std::array<double, N>;

  NonNegativeFit(std::span<const double> gram, const Weights& b, std::size_t n)
      : gram_(gram), b_(b), n_(n) {}

  Weights run() {
    for (std::size_t round = 0; round < 3 * N; ++round) {
      const std::size_t next = steepest();
      if (next == n_) break;
      free_[next] = true;
      while (!toFeasible()) {
      }
    }
    return w_;
  }

 private:
  /// The bound weight whose growth helps most, or n.
  std::size_t steepest() const {
    std::size_t best = n_;
    double most = 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      if (free_[i]) continue;
      double slope = b_[i];
      for (std::size_t j = 0; j < n_; ++j) slope -= gram_[i * N + j] * w_[j];
      const double gain = slope / std::sqrt(gram_[i * N + i]);
      const double noise = 1e-9 * std::sqrt(gram_[i * N + i]);
      if (gain > std::max(most, noise)) {
        best = i;
        most = gain;
      }
    }
    return best;
  }

  /// Solves for the free weights. Where one would be negative, goes as far as it may and binds it.
  bool toFeasible() {
    constexpr double kRidge = 1e-12;
    std::array<std::size_t, N> of{};
    std::size_t m = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      if (free_[i]) of[m++] = i;
    }
    std::array<Weights, N> g{};
    Weights b{};
    for (std::size_t i = 0; i < m; ++i) {
      b[i] = b_[of[i]];
      for (std::size_t j = 0; j < m; ++j) g[i][j] = gram_[of[i] * N + of[j]];
      g[i][i] *= 1.0 + kRidge;
    }
    const Weights z = solveSymmetric(g, b, m);
    double step = 1.0;
    std::size_t first = m;  // the one that is bound first
    for (std::size_t i = 0; i < m; ++i) {
      const double w = w_[of[i]];
      if (z[i] > 0.0 || w >= step * (w - z[i])) continue;
      step = w / (w - z[i]);
      first = i;
    }
    bool feasible = true;
    for (std::size_t i = 0; i < m; ++i) {
      const std::size_t p = of[i];
      w_[p] += step * (z[i] - w_[p]);
      if (i == first || (z[i] <= 0.0 && w_[p] <= 0.0)) {
        w_[p] = 0.0;
        free_[p] = false;
        feasible = false;
      }
    }
    return feasible || m == 0;
  }

  std::span<const double> gram_;
  const Weights& b_;
  std::size_t n_;
  Weights w_{};
  std::array<bool, N> free_{};
};

/// The weights β ≥ 0 that minimise |ℓ − Σ βᵢ ℓᵢ| over the first `n` vectors ℓᵢ, from the products
/// ℓᵢ · ℓⱼ = `gram[N i + j]` and `b` = ℓᵢ · ℓ; the others are 0.
template <std::size_t N>
std::array<double, N> nonNegativeFit(std::span<const double> gram, const std::array<double, N>& b,
                                     std::size_t n) {
  return NonNegativeFit<N>(gram, b, n).run();
}

}  // namespace merge2d
