#include "src2d/core/nonnegative_fit.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

namespace merge2d {
namespace {

constexpr std::size_t kMost = 8;
using Weights = std::array<double, kMost>;
using Vector3 = std::array<double, 3>;

double dot(const Vector3& x, const Vector3& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

Weights fit(const std::vector<Vector3>& of, const Vector3& x) {
  std::array<double, kMost * kMost> gram{};
  Weights b{};
  for (std::size_t i = 0; i < of.size(); ++i) {
    b[i] = dot(of[i], x);
    for (std::size_t j = 0; j < of.size(); ++j) {
      gram[i * kMost + j] = dot(of[i], of[j]);
    }
  }
  return nonNegativeFit(gram, b, of.size());
}

TEST(NonNegativeFit, FindsTheWeightsOfAPointInTheCone) {
  const Weights w = fit({{1, 0, 0}, {1, 1, 0}, {0, 0, 2}}, {3, 1, 4});
  EXPECT_NEAR(w[0], 2.0, 1e-9);
  EXPECT_NEAR(w[1], 1.0, 1e-9);
  EXPECT_NEAR(w[2], 2.0, 1e-9);
}

TEST(NonNegativeFit, LeavesOutAVectorThatWouldHaveToPull) {
  const Weights w = fit({{1, 0, 0}, {1, 1, 0}}, {2, -1, 0});
  EXPECT_NEAR(w[0], 2.0, 1e-9);
  EXPECT_EQ(w[1], 0.0);
}

TEST(NonNegativeFit, OfTheOppositeDirectionIsNothing) {
  EXPECT_EQ(fit({{1, 2, 3}}, {-1, -2, -3}), Weights{});
}

TEST(NonNegativeFit, OfNoVectorsIsNothing) { EXPECT_EQ(fit({}, {1, 2, 3}), Weights{}); }

/// The conditions of Karush, Kuhn and Tucker: no slope where a weight is free, none upwards where
/// it is bound.
TEST(NonNegativeFit, IsOptimalForRandomVectors) {
  std::mt19937 random(7);
  const auto number = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
  for (int round = 0; round < 2000; ++round) {
    std::vector<Vector3> of(1 + round % kMost);
    for (Vector3& v : of) v = {number(), number(), number()};
    const Vector3 x{number(), number(), number()};
    const Weights w = fit(of, x);
    Vector3 rest = x;
    for (std::size_t i = 0; i < of.size(); ++i) {
      ASSERT_GE(w[i], 0.0);
      for (std::size_t k = 0; k < 3; ++k) rest[k] -= w[i] * of[i][k];
    }
    for (std::size_t i = 0; i < of.size(); ++i) {
      const double slope = dot(of[i], rest);
      EXPECT_LT(slope, 1e-6) << "round " << round;
      if (w[i] <= 1e-9) continue;
      EXPECT_NEAR(slope, 0.0, 1e-6) << "round " << round;
    }
  }
}

}  // namespace
}  // namespace merge2d
