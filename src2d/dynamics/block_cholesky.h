#pragma once
/// H = L Lᵀ of a symmetric sparse matrix in blocks of 3×3, one for each body and each pair of
/// bodies that share a row.

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace merge2d {

using Block3 = std::array<double, 9>;  ///< by rows

class BlockCholesky {
 public:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;

  /// Chooses an order for `size` bodies that fills in little, and the places of the blocks of L.
  /// `pairs`: the blocks of the matrix, column ≤ row, ascending, with all of the diagonal.
  void analyze(std::uint32_t size, std::span<const Pair> pairs);

  /// Factorises the matrix of these blocks, in the order of the pairs; of diagonal blocks the lower
  /// triangle counts. False where it is not positive definite.
  bool factorize(std::span<const Block3> blocks);

  /// x ← H⁻¹ x, three numbers a body.
  void solve(std::vector<double>& x) const;

 private:
  /// A block of the matrix in a column of the ordered one.
  struct Source {
    std::uint32_t row = 0, pair = 0;
    bool turned = false;  ///< its transpose stands there
  };

  void order(std::uint32_t size, std::span<const Pair> pairs);
  void fillIn();
  void load(std::uint32_t column, std::span<const Block3> blocks);
  void subtract(std::uint32_t column);
  bool finish(std::uint32_t column);
  /// Has column k wait for the column of its next row.
  void await(std::uint32_t k);

  std::uint32_t size_ = 0;
  std::vector<std::uint32_t> place_;                 ///< per body: its row
  std::vector<Source> sources_;                      ///< by columns
  std::vector<std::uint32_t> first_source_, first_;  ///< per column
  std::vector<std::uint32_t> rows_;                  ///< of L below the diagonal, by columns
  std::vector<Block3> lower_, diagonal_;             ///< their blocks
  std::vector<Block3> column_;                       ///< per row: the column that is computed
  std::vector<std::uint32_t> next_, waiting_,
      at_;  ///< per column: a list of those that wait for it
};

}  // namespace merge2d
