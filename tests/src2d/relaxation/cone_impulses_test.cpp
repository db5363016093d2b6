#include "src2d/relaxation/cone_impulses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace merge2d {
namespace {

constexpr double kFriction = 0.6;

/// Of a box of 1 m on the ground, whose size is taken as 1 m: both edges at both corners, each of
/// which bears a part of `held`.
std::vector<ConeEdge> feet(double held) {
  std::vector<ConeEdge> edges;
  for (const double x : {-0.5, 0.5}) {
    for (const double s : {kFriction, -kFriction}) {
      // The tangent is the normal turned by +90 degrees: (-1, 0).
      edges.push_back({.on = {-s, 1.0, x - 0.5 * s}, .slope = s, .held = 0.25 * held});
    }
  }
  return edges;
}

double sizeOf(const Wrench& w) { return std::sqrt(w.dot(w)); }

double leftOf(double held, const Wrench& load) {
  std::vector<ConeEdge> edges = feet(held);
  return sizeOf(balance(edges, load));
}

TEST(ConeImpulses, TheWeightOfABoxIsSharedEvenly) {
  std::vector<ConeEdge> edges = feet(0.0);
  EXPECT_NEAR(sizeOf(balance(edges, {0.0, -1.0, 0.0})), 0.0, 1e-9);
  for (const ConeEdge& edge : edges) EXPECT_NEAR(edge.change, 0.25, 1e-9);
}

TEST(ConeImpulses, ALoadBesideTheFeetIsNotBalanced) {
  EXPECT_NEAR(leftOf(0.0, {0.0, -1.0, 0.49}), 0.0, 1e-9);
  EXPECT_GT(leftOf(0.0, {0.0, -1.0, 0.51}), 1e-3);
}

/// A load through the middle of the feet, which has a moment of half its horizontal part.
TEST(ConeImpulses, FrictionBearsAsMuchAsItsCone) {
  EXPECT_NEAR(leftOf(0.0, {0.59, -1.0, 0.295}), 0.0, 1e-9);
  EXPECT_GT(leftOf(0.0, {0.61, -1.0, 0.305}), 1e-3);
}

TEST(ConeImpulses, FeetPullByNoMoreThanTheyBear) {
  EXPECT_GT(leftOf(0.0, {0.0, 0.1, 0.0}), 0.09);
  EXPECT_NEAR(leftOf(1.0, {0.0, 0.9, 0.0}), 0.0, 1e-9);
  EXPECT_GT(leftOf(1.0, {0.0, 1.1, 0.0}), 0.09);
}

TEST(ConeImpulses, TheEdgesOfAPointAddUpToItsImpulses) {
  constexpr double kNormal = 2.0, kTangent = -0.7;
  const double up = heldAlong(kFriction, kNormal, kTangent);
  const double down = heldAlong(-kFriction, kNormal, kTangent);
  EXPECT_NEAR(up + down, kNormal, 1e-12);
  EXPECT_NEAR(kFriction * (up - down), kTangent, 1e-12);
}

}  // namespace
}  // namespace merge2d
