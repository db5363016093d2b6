#pragma once
/// A symmetric sparse matrix of 3×3 blocks, one for each body and for each pair of bodies that
/// share a row: the lower part alone, filled anew again and again.

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "src2d/dynamics/block_cholesky.h"

namespace merge2d {

class BodyMatrix {
 public:
  using Vec = std::array<double, 3>;

  /// The bodies p and q share a row; to be called before `layOut`.
  void share(std::uint32_t p, std::uint32_t q) {
    pairs_.push_back({std::min(p, q), std::max(p, q)});
  }

  /// Chooses the blocks, one for each body and for each pair that shares a row.
  void layOut(std::uint32_t bodies) {
    for (std::uint32_t i = 0; i < bodies; ++i) pairs_.push_back({i, i});
    std::ranges::sort(pairs_);
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    blocks_.resize(pairs_.size());
    for (std::uint32_t i = 0; i < bodies; ++i) diagonal_.push_back(blockOf(i, i));
    factor_.analyze(bodies, pairs_);
  }

  /// Sets all values to zero.
  void clear() { std::ranges::fill(blocks_, Block3{}); }

  /// The block of two bodies, in any order.
  std::uint32_t blockOf(std::uint32_t p, std::uint32_t q) const {
    const std::pair key{std::min(p, q), std::max(p, q)};
    return static_cast<std::uint32_t>(std::ranges::lower_bound(pairs_, key) - pairs_.begin());
  }

  /// Adds g x yᵀ to a block; x belongs to the body with the higher number.
  void add(std::uint32_t block, const Vec& x, const Vec& y, double g) {
    Block3& to = blocks_[block];
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) to[3 * r + c] += g * x[r] * y[c];
    }
  }

  /// Adds to the diagonal of a body's block.
  void add(std::uint32_t body, const Vec& diagonal) {
    Block3& to = blocks_[diagonal_[body]];
    for (std::size_t c = 0; c < 3; ++c) to[4 * c] += diagonal[c];
  }

  /// False where it is not positive definite.
  bool factorize() { return factor_.factorize(blocks_); }
  /// x ← H⁻¹ x, once it is factorised.
  void solve(std::vector<double>& x) const { factor_.solve(x); }

 private:
  std::vector<BlockCholesky::Pair> pairs_;  ///< of columns and rows, ascending
  std::vector<Block3> blocks_;
  std::vector<std::uint32_t> diagonal_;  ///< per body
  BlockCholesky factor_;
};

}  // namespace merge2d
