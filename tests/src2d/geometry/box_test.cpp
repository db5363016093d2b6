#include "src2d/geometry/box.h"

#include <gtest/gtest.h>

#include <numbers>

namespace merge2d {
namespace {

double area(const OrientedBox& box) { return 4.0 * box.half.x() * box.half.y(); }

TEST(Box, BoundsOfATurnedSquareReachItsCorners) {
  const Aabb box = bounds(makeBox(1.0, 1.0), Pose::at({2.0, 0.0}, std::numbers::pi / 4.0));
  const double r = std::numbers::sqrt2 / 2.0;
  EXPECT_NEAR((box.lower - Vec2(2.0 - r, -r)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((box.upper - Vec2(2.0 + r, r)).norm(), 0.0, 1e-15);
}

TEST(Box, BoundsOfADiscDoNotTurn) {
  const Aabb box = bounds(Circle{{1.0, 0.0}, 0.5}, Pose::at({0.0, 0.0}, std::numbers::pi / 2.0));
  EXPECT_NEAR((box.lower - Vec2(-0.5, 0.5)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((box.upper - Vec2(0.5, 1.5)).norm(), 0.0, 1e-15);
}

TEST(Box, TightBoxOfATurnedBoxIsThatBox) {
  const Pose pose = Pose::at({3.0, -2.0}, 0.4);
  const OrientedBox box = tightBox(makeBox(4.0, 1.0, pose).vertices);
  EXPECT_NEAR(area(box), 4.0, 1e-12);
  EXPECT_NEAR(box.half.x(), 2.0, 1e-12);
  EXPECT_NEAR(box.frame.rotation.angle(), 0.4, 1e-12);
  EXPECT_NEAR((box.frame.position - pose.position).norm(), 0.0, 1e-12);
}

TEST(Box, TightBoxOfATurnedBoxTurnsByAtMost45Degrees) {
  const OrientedBox box = tightBox(makeBox(4.0, 1.0, Pose::at({0.0, 0.0}, 1.4)).vertices);
  EXPECT_NEAR(box.frame.rotation.angle(), 1.4 - std::numbers::pi / 2.0, 1e-12);
  EXPECT_NEAR(box.half.y(), 2.0, 1e-12);
}

TEST(Box, TightBoxOfAnUprightBoxIsExactlyUpright) {
  const OrientedBox box = tightBox(makeBox(0.3, 0.7, Pose::at({0.1, 0.2}, 0.0)).vertices);
  EXPECT_EQ(box.frame.rotation.c, 1.0);
  EXPECT_EQ(box.frame.rotation.s, 0.0);
}

TEST(Box, TightBoxPrefersTheAxesWhenAreasTie) {
  // A regular octagon has the same box along each of its edges.
  std::vector<Vec2> octagon;
  for (int i = 0; i < 8; ++i) {
    octagon.push_back(Rotation::of((i + 0.5) * std::numbers::pi / 4.0) * Vec2(1.0, 0.0));
  }
  EXPECT_EQ(tightBox(octagon).frame.rotation.s, 0.0);
}

TEST(Box, TightBoxTakesDegenerateInput) {
  EXPECT_EQ(tightBox({}).half, Vec2::Zero());
  const OrientedBox point = tightBox({{1.0, 2.0}, {1.0, 2.0}});
  EXPECT_EQ(point.frame.position, Vec2(1.0, 2.0));
  EXPECT_EQ(point.half, Vec2::Zero());
  const OrientedBox segment = tightBox({{0.0, 0.0}, {3.0, 4.0}, {1.5, 2.0}});
  EXPECT_NEAR(segment.half.maxCoeff(), 2.5, 1e-12);
  EXPECT_NEAR(segment.half.minCoeff(), 0.0, 1e-12);
}

TEST(Box, TightBoxHoldsAllPointsAndIsNoLargerThanTheUprightOne) {
  std::vector<Vec2> points;
  Aabb upright;
  for (int i = 0; i < 40; ++i) {
    points.emplace_back(std::cos(2.399 * i) * i, std::sin(1.7 * i) * 0.3 * i + 0.8 * i);
    upright.include(points.back());
  }
  const OrientedBox box = tightBox(points);
  for (const Vec2& p : points) {
    const Vec2 local = box.frame.toLocal(p);
    EXPECT_LE(std::abs(local.x()), box.half.x() + 1e-9);
    EXPECT_LE(std::abs(local.y()), box.half.y() + 1e-9);
  }
  EXPECT_LE(area(box), upright.extent().prod() + 1e-9);
}

TEST(Box, OutlineOfADiscIsItsBoundingSquare) {
  Aabb box;
  for (const Vec2& p : outlinePoints(Circle{{1.0, 2.0}, 0.5})) box.include(p);
  EXPECT_EQ(box.lower, Vec2(0.5, 1.5));
  EXPECT_EQ(box.upper, Vec2(1.5, 2.5));
}

}  // namespace
}  // namespace merge2d
