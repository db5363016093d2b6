#include "src2d/dynamics/block_cholesky.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "src2d/core/ids.h"

namespace merge2d {
namespace {

/// x −= y zᵀ.
void subtractProduct(Block3& x, const Block3& y, const Block3& z) {
  for (std::size_t r = 0; r < 9; r += 3) {
    const double p = y[r], q = y[r + 1], s = y[r + 2];
    x[r] -= p * z[0] + q * z[1] + s * z[2];
    x[r + 1] -= p * z[3] + q * z[4] + s * z[5];
    x[r + 2] -= p * z[6] + q * z[7] + s * z[8];
  }
}

/// The lower triangle of x by its Cholesky factor, with the inverse of its diagonal there. False
/// where x is not positive definite.
bool factorizeBlock(Block3& x) {
  for (std::size_t c = 0; c < 3; ++c) {
    double pivot = x[4 * c];
    for (std::size_t k = 0; k < c; ++k) pivot -= x[3 * c + k] * x[3 * c + k];
    if (!(pivot > 0.0)) return false;
    const double inverse = 1.0 / std::sqrt(pivot);
    x[4 * c] = inverse;
    for (std::size_t r = c + 1; r < 3; ++r) {
      for (std::size_t k = 0; k < c; ++k) x[3 * r + c] -= x[3 * r + k] * x[3 * c + k];
      x[3 * r + c] *= inverse;
    }
  }
  return true;
}

/// x ← L⁻¹ x of three numbers.
void solveLower(const Block3& l, double* x) {
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t k = 0; k < r; ++k) x[r] -= l[3 * r + k] * x[k];
    x[r] *= l[4 * r];
  }
}

/// x ← L⁻ᵀ x of three numbers.
void solveUpper(const Block3& l, double* x) {
  for (std::size_t r = 3; r-- > 0;) {
    for (std::size_t k = r + 1; k < 3; ++k) x[r] -= l[3 * k + r] * x[k];
    x[r] *= l[4 * r];
  }
}

}  // namespace

void BlockCholesky::analyze(std::uint32_t size, std::span<const Pair> pairs) {
  size_ = size;
  order(size, pairs);
  first_source_.assign(size + 1, 0);
  const auto placed = [&](const Pair& pair) {
    return std::minmax(place_[pair.first], place_[pair.second]);
  };
  for (const Pair& pair : pairs) ++first_source_[placed(pair).first + 1];
  for (std::uint32_t c = 0; c < size; ++c) first_source_[c + 1] += first_source_[c];
  sources_.resize(pairs.size());
  std::vector<std::uint32_t> end(first_source_.begin(), first_source_.end() - 1);
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    const auto [column, row] = placed(pairs[i]);
    sources_[end[column]++] = {row, i, place_[pairs[i].first] > place_[pairs[i].second]};
  }
  fillIn();
  lower_.resize(rows_.size());
  diagonal_.resize(size);
  column_.assign(size, {});
}

/// Approximate minimum degree.
void BlockCholesky::order(std::uint32_t size, std::span<const Pair> pairs) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * pairs.size());
  for (const auto& [column, row] : pairs) {
    entries.emplace_back(static_cast<int>(row), static_cast<int>(column), 1.0);
    if (row != column) entries.emplace_back(static_cast<int>(column), static_cast<int>(row), 1.0);
  }
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(matrix, permutation);
  place_.resize(size);
  for (std::uint32_t i = 0; i < size; ++i) {  // the permutation tells which body has a row
    place_[static_cast<std::uint32_t>(permutation.indices()[i])] = i;
  }
}

/// The rows of each column of L: those of the matrix, and those of the columns whose first row
/// below the diagonal it is.
void BlockCholesky::fillIn() {
  first_.assign(1, 0);
  rows_.clear();
  std::vector<std::uint32_t> child(size_, kNone), sibling(size_, kNone), seen(size_, kNone);
  for (std::uint32_t c = 0; c < size_; ++c) {
    seen[c] = c;
    const auto add = [&](std::uint32_t row) {
      if (seen[row] == c) return;
      seen[row] = c;
      rows_.push_back(row);
    };
    for (std::uint32_t i = first_source_[c]; i < first_source_[c + 1]; ++i) add(sources_[i].row);
    for (std::uint32_t k = child[c]; k != kNone; k = sibling[k]) {
      for (std::uint32_t i = first_[k]; i < first_[k + 1]; ++i) add(rows_[i]);
    }
    std::sort(rows_.begin() + first_[c], rows_.end());
    first_.push_back(static_cast<std::uint32_t>(rows_.size()));
    if (first_[c] == first_[c + 1]) continue;
    const std::uint32_t parent = rows_[first_[c]];
    sibling[c] = child[parent];
    child[parent] = c;
  }
}

void BlockCholesky::load(std::uint32_t column, std::span<const Block3> blocks) {
  for (std::uint32_t i = first_source_[column]; i < first_source_[column + 1]; ++i) {
    const Source& source = sources_[i];
    const Block3& b = blocks[source.pair];
    column_[source.row] =
        source.turned ? Block3{b[0], b[3], b[6], b[1], b[4], b[7], b[2], b[5], b[8]} : b;
  }
}

void BlockCholesky::await(std::uint32_t k) {
  if (at_[k] == first_[k + 1]) return;
  std::uint32_t& list = waiting_[rows_[at_[k]]];
  next_[k] = list;
  list = k;
}

/// Takes the products of the columns before from this one.
void BlockCholesky::subtract(std::uint32_t column) {
  for (std::uint32_t k = waiting_[column], after = kNone; k != kNone; k = after) {
    after = next_[k];
    const Block3 at_column = lower_[at_[k]];
    for (std::uint32_t i = at_[k]; i < first_[k + 1]; ++i) {
      subtractProduct(column_[rows_[i]], lower_[i], at_column);
    }
    ++at_[k];
    await(k);
  }
}

bool BlockCholesky::finish(std::uint32_t column) {
  Block3& diagonal = diagonal_[column];
  diagonal = column_[column];
  column_[column] = {};
  if (!factorizeBlock(diagonal)) return false;
  for (std::uint32_t i = first_[column]; i < first_[column + 1]; ++i) {
    lower_[i] = column_[rows_[i]];
    column_[rows_[i]] = {};
    for (std::size_t r = 0; r < 3; ++r) solveLower(diagonal, &lower_[i][3 * r]);
  }
  at_[column] = first_[column];
  await(column);
  return true;
}

bool BlockCholesky::factorize(std::span<const Block3> blocks) {
  waiting_.assign(size_, kNone);
  next_.assign(size_, kNone);
  at_.assign(size_, 0);
  column_.assign(size_, {});
  for (std::uint32_t column = 0; column < size_; ++column) {
    load(column, blocks);
    subtract(column);
    if (!finish(column)) return false;
  }
  return true;
}

void BlockCholesky::solve(std::vector<double>& x) const {
  std::vector<double> y(x.size());
  for (std::uint32_t b = 0; b < size_; ++b) std::copy_n(&x[3 * b], 3, &y[3 * place_[b]]);
  for (std::uint32_t c = 0; c < size_; ++c) {
    double* of = &y[3 * c];
    solveLower(diagonal_[c], of);
    for (std::uint32_t i = first_[c]; i < first_[c + 1]; ++i) {
      const Block3& l = lower_[i];
      double* to = &y[3 * rows_[i]];
      for (std::size_t r = 0; r < 3; ++r) {
        to[r] -= l[3 * r] * of[0] + l[3 * r + 1] * of[1] + l[3 * r + 2] * of[2];
      }
    }
  }
  for (std::uint32_t c = size_; c-- > 0;) {
    double* of = &y[3 * c];
    for (std::uint32_t i = first_[c]; i < first_[c + 1]; ++i) {
      const Block3& l = lower_[i];
      const double* from = &y[3 * rows_[i]];
      for (std::size_t r = 0; r < 3; ++r) {
        of[r] -= l[r] * from[0] + l[3 + r] * from[1] + l[6 + r] * from[2];
      }
    }
    solveUpper(diagonal_[c], of);
  }
  for (std::uint32_t b = 0; b < size_; ++b) std::copy_n(&y[3 * place_[b]], 3, &x[3 * b]);
}

}  // namespace merge2d
