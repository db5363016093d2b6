#include "src2d/dynamics/block_cholesky.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace merge2d {
namespace {

/// Bodies of which some share rows: J Jᵀ of random J, and a mass on the diagonal.
struct System {
  std::uint32_t bodies = 0;
  std::vector<BlockCholesky::Pair> pairs;
  std::vector<Block3> blocks;

  /// H x, three numbers a body.
  std::vector<double> times(const std::vector<double>& x) const {
    std::vector<double> y(x.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto [column, row] = pairs[i];
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) {
          y[3 * row + r] += blocks[i][3 * r + c] * x[3 * column + c];
          if (row != column) y[3 * column + c] += blocks[i][3 * r + c] * x[3 * row + r];
        }
      }
    }
    return y;
  }
};

System randomSystem(std::uint32_t bodies, double mass, std::mt19937& random) {
  const auto number = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
  std::set<BlockCholesky::Pair> chosen;
  for (std::uint32_t i = 0; i < bodies; ++i) {
    chosen.insert({i, i});
    const auto other = static_cast<std::uint32_t>(random() % bodies);
    if (other != i) chosen.insert(std::minmax(i, other));
  }
  System s{bodies, {chosen.begin(), chosen.end()}, {}};
  s.blocks.assign(s.pairs.size(), {});
  const auto blockOf = [&](std::uint32_t p, std::uint32_t q) -> Block3& {
    const auto at = std::ranges::find(s.pairs, BlockCholesky::Pair(std::minmax(p, q)));
    return s.blocks[static_cast<std::size_t>(at - s.pairs.begin())];
  };
  for (std::uint32_t i = 0; i < bodies; ++i) {
    for (std::size_t k = 0; k < 3; ++k) blockOf(i, i)[4 * k] += mass;
  }
  for (const auto& [column, row] : s.pairs) {
    if (row == column) continue;
    const std::array<double, 3> x{number(), number(), number()}, y{number(), number(), number()};
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        blockOf(column, column)[3 * r + c] += x[r] * x[c];
        blockOf(row, row)[3 * r + c] += y[r] * y[c];
        blockOf(row, column)[3 * r + c] += y[r] * x[c];
      }
    }
  }
  return s;
}

TEST(BlockCholesky, FindsTheVectorThatTheMatrixTookThere) {
  std::mt19937 random(5);
  for (const std::uint32_t bodies : {1U, 2U, 7U, 40U, 200U}) {
    const System s = randomSystem(bodies, 0.1, random);
    std::vector<double> x(3 * static_cast<std::size_t>(bodies));
    for (double& v : x) v = static_cast<double>(random() % 1000) - 500.0;
    std::vector<double> found = s.times(x);
    BlockCholesky factor;
    factor.analyze(bodies, s.pairs);
    ASSERT_TRUE(factor.factorize(s.blocks));
    factor.solve(found);
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(found[i], x[i], 1e-6) << bodies;
  }
}

TEST(BlockCholesky, TellsAMatrixThatIsNotPositiveDefinite) {
  std::mt19937 random(6);
  System s = randomSystem(20, 0.1, random);
  BlockCholesky factor;
  factor.analyze(s.bodies, s.pairs);
  Block3& first = s.blocks.front();  // that of the first body
  const double before = std::exchange(first[8], -1.0);
  EXPECT_FALSE(factor.factorize(s.blocks));
  first[8] = std::nan("");
  EXPECT_FALSE(factor.factorize(s.blocks));
  first[8] = before;
  EXPECT_TRUE(factor.factorize(s.blocks)) << "and begins anew";
}

}  // namespace
}  // namespace merge2d
