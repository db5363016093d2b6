#include "src2d/merging/nonnegative_fit.h"

#include <algorithm>
#include <cmath>

#include "src2d/core/small_cholesky.h"

namespace merge2d {
namespace {

constexpr std::size_t kFitted = LoadCertificate::kMost;

class NonNegativeFit {
 public:
  NonNegativeFit(std::span<const double> gram, const LoadCertificate::Weights& b, std::size_t n)
      : gram_(gram), b_(b), n_(n) {}

  LoadCertificate::Weights run() {
    for (std::size_t round = 0; round < 3 * kFitted; ++round) {
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
      for (std::size_t j = 0; j < n_; ++j) slope -= gram_[i * kFitted + j] * w_[j];
      const double gain = slope / std::sqrt(gram_[i * kFitted + i]);
      const double noise = 1e-9 * std::sqrt(gram_[i * kFitted + i]);
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
    std::array<std::size_t, kFitted> of{};
    std::size_t m = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      if (free_[i]) of[m++] = i;
    }
    std::array<LoadCertificate::Weights, kFitted> g{};
    LoadCertificate::Weights b{};
    for (std::size_t i = 0; i < m; ++i) {
      b[i] = b_[of[i]];
      for (std::size_t j = 0; j < m; ++j) g[i][j] = gram_[of[i] * kFitted + of[j]];
      g[i][i] *= 1.0 + kRidge;
    }
    const LoadCertificate::Weights z = solveSymmetric(g, b, m);
    double step = 1.0;
    for (std::size_t i = 0; i < m; ++i) {
      const double w = w_[of[i]];
      if (z[i] <= 0.0) step = std::min(step, w / (w - z[i]));
    }
    bool feasible = true;
    for (std::size_t i = 0; i < m; ++i) {
      const std::size_t p = of[i];
      w_[p] += step * (z[i] - w_[p]);
      if (z[i] <= 0.0 && w_[p] <= 1e-14) {
        w_[p] = 0.0;
        free_[p] = false;
        feasible = false;
      }
    }
    return feasible || m == 0;
  }

  std::span<const double> gram_;
  const LoadCertificate::Weights& b_;
  std::size_t n_;
  LoadCertificate::Weights w_{};
  std::array<bool, kFitted> free_{};
};

}  // namespace

LoadCertificate::Weights nonNegativeFit(std::span<const double> gram,
                                        const LoadCertificate::Weights& b, std::size_t n) {
  return NonNegativeFit(gram, b, n).run();
}

}  // namespace merge2d
