#include "src2d/relaxation/cone_impulses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace merge2d {
namespace {

constexpr double kFriction = 0.6;

/// A corner of a box of 1 m on the ground, at `x` from its middle, with a normal impulse.
ConePoint corner(double x, double lambda_n) {
  return {.nx = 0.0,
          .ny = 1.0,
          .arm_bn = x,
          .arm_bt = -0.5,  // the tangent is the normal turned by +90 degrees: (-1, 0)
          .mu = kFriction,
          .lambda_n = lambda_n};
}

/// Both edges at both corners of that box, whose size is taken as 1 m: each bears a part of `held`.
std::vector<ConeEdge> feet(double held) {
  std::vector<ConeEdge> edges;
  for (const double x : {-0.5, 0.5}) addEdges(corner(x, 0.5 * held), true, 1.0, 1.0, {}, edges);
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
  ConePoint point = corner(0.5, 2.0);
  point.lambda_t = -0.7;
  std::vector<ConeEdge> edges;
  addEdges(point, true, 1.0, 1.0, {}, edges);
  Wrench on_box;
  for (const ConeEdge& edge : edges) on_box += edge.held * edge.on;
  EXPECT_NEAR(on_box.x, 0.7, 1e-12);
  EXPECT_NEAR(on_box.y, 2.0, 1e-12);
  EXPECT_NEAR(on_box.spin, 0.5 * 2.0 - 0.5 * -0.7, 1e-12);
}

/// Action and reaction: the same edge, seen from either body.
TEST(ConeImpulses, AnEdgePushesBothBodiesAlike) {
  ConePoint point = corner(0.5, 2.0);
  point.arm_an = point.arm_bn;
  point.arm_at = point.arm_bt;
  std::vector<ConeEdge> seen_by_b, seen_by_a;
  addEdges(point, true, 2.0, 4.0, {}, seen_by_b);
  addEdges(point, false, 4.0, 2.0, {}, seen_by_a);
  for (std::size_t i = 0; i < 2; ++i) {
    const ConeEdge &b = seen_by_b[i], &a = seen_by_a[i];
    EXPECT_EQ(b.on.x, a.on_other.x);
    EXPECT_EQ(b.on.spin, a.on_other.spin);
    EXPECT_EQ(b.on.y, -b.on_other.y);
    EXPECT_EQ(b.on.spin, -2.0 * b.on_other.spin);
  }
}

}  // namespace
}  // namespace merge2d
