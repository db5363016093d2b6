#include "src2d/core/small_cholesky.h"

#include <gtest/gtest.h>

namespace merge2d {
namespace {

using Vector = std::array<double, 4>;

TEST(SmallCholesky, SolvesASystemWhoseSolutionIsKnown) {
  const std::array<Vector, 4> a{{{4, 1, 0, 0}, {1, 3, 1, 0}, {0, 1, 2, 0}, {0, 0, 0, 0}}};
  const Vector x = solveSymmetric<4>(a, {6, 10, 8, 0}, 3);  // of x = (1, 2, 3)
  EXPECT_NEAR(x[0], 1.0, 1e-14);
  EXPECT_NEAR(x[1], 2.0, 1e-14);
  EXPECT_NEAR(x[2], 3.0, 1e-14);
  EXPECT_EQ(x[3], 0.0) << "which is not asked for";
}

TEST(SmallCholesky, OfTwoEqualRowsTheLaterUnknownIsZero) {
  const std::array<Vector, 4> a{{{2, 2, 0, 0}, {2, 2, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  const Vector x = solveSymmetric<4>(a, {4, 4, 5, 6}, 4);
  EXPECT_EQ(x, (Vector{2, 0, 5, 6}));
}

}  // namespace
}  // namespace merge2d
