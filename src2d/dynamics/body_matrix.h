#pragma once
/// A symmetric sparse matrix of 3×3 blocks, one for each body and for each pair of bodies that
/// share a row: the lower part alone, filled anew again and again.

#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace merge2d {

class BodyMatrix {
 public:
  using Matrix = Eigen::SparseMatrix<double>;
  using Vec = std::array<double, 3>;

  /// The bodies p and q share a row; to be called before `layOut`.
  void share(std::uint32_t p, std::uint32_t q) {
    pairs_.push_back({std::min(p, q), std::max(p, q)});
  }

  /// Chooses the entries, one block for each body and for each pair that shares a row.
  void layOut(std::uint32_t bodies) {
    for (std::uint32_t i = 0; i < bodies; ++i) pairs_.push_back({i, i});
    std::ranges::sort(pairs_);
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(9 * pairs_.size());
    for (const auto& [q, p] : pairs_) {
      for (int c = 0; c < 3; ++c) {
        for (int r = p == q ? c : 0; r < 3; ++r) {
          entries.emplace_back(static_cast<int>(3 * p) + r, static_cast<int>(3 * q) + c, 0.0);
        }
      }
    }
    const auto size = 3 * static_cast<Eigen::Index>(bodies);
    matrix_.resize(size, size);
    matrix_.setFromTriplets(entries.begin(), entries.end());
    for (const auto& [q, p] : pairs_)
      place_.push_back(placeOf(static_cast<int>(p), static_cast<int>(q)));
  }

  /// Sets all values to zero.
  void clear() { matrix_.coeffs().setZero(); }

  /// The block of two bodies, in any order.
  std::uint32_t blockOf(std::uint32_t p, std::uint32_t q) const {
    const std::pair key{std::min(p, q), std::max(p, q)};
    return static_cast<std::uint32_t>(std::ranges::lower_bound(pairs_, key) - pairs_.begin());
  }

  /// Adds g x yᵀ to a block; x belongs to the body with the higher number.
  void add(std::uint32_t block, const Vec& x, const Vec& y, double g) {
    const bool diagonal = pairs_[block].first == pairs_[block].second;
    double* values = matrix_.valuePtr();
    for (std::size_t c = 0; c < 3; ++c) {
      double* column = values + place_[block][c];
      for (std::size_t r = diagonal ? c : 0; r < 3; ++r) column[r] += g * x[r] * y[c];
    }
  }

  /// Adds to the diagonal of a body's block.
  void add(std::uint32_t body, const Vec& diagonal) {
    const auto& place = place_[blockOf(body, body)];
    for (std::size_t c = 0; c < 3; ++c) {
      matrix_.valuePtr()[place[c] + static_cast<std::ptrdiff_t>(c)] += diagonal[c];
    }
  }

  const Matrix& matrix() const { return matrix_; }

 private:
  /// Where the block's columns would begin, each with its three rows.
  std::array<std::ptrdiff_t, 3> placeOf(int p, int q) const {
    std::array<std::ptrdiff_t, 3> place{};
    const int *rows = matrix_.innerIndexPtr(), *columns = matrix_.outerIndexPtr();
    for (int c = 0; c < 3; ++c) {
      const int column = 3 * q + c, row = p == q ? column : 3 * p;
      const int* at = std::lower_bound(rows + columns[column], rows + columns[column + 1], row);
      place[static_cast<std::size_t>(c)] = at - rows - (p == q ? c : 0);
    }
    return place;
  }

  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;  ///< of columns and rows, ascending
  std::vector<std::array<std::ptrdiff_t, 3>> place_;            ///< per block, among the values
  Matrix matrix_;
};

}  // namespace merge2d
