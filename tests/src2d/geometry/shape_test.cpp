#include "src2d/geometry/shape.h"

#include <gtest/gtest.h>

#include <numbers>

namespace merge2d {
namespace {

TEST(Shape, BoxHasItsTextbookArea) {
  const AreaProperties p = areaProperties(makeBox(4.0, 2.0, Pose::at({1.0, 3.0}, 0.3)));
  EXPECT_NEAR(p.area, 8.0, 1e-13);
  EXPECT_NEAR((p.centroid - Vec2(1.0, 3.0)).norm(), 0.0, 1e-13);
  EXPECT_NEAR(p.secondMoment, 8.0 * (16.0 + 4.0) / 12.0, 1e-12);
}

TEST(Shape, DiscHasItsTextbookArea) {
  const AreaProperties p = areaProperties(Circle{{2.0, -1.0}, 0.5});
  EXPECT_DOUBLE_EQ(p.area, std::numbers::pi * 0.25);
  EXPECT_EQ(p.centroid, Vec2(2.0, -1.0));
  EXPECT_DOUBLE_EQ(p.secondMoment, std::numbers::pi * 0.0625 / 2.0);
}

TEST(Shape, TriangleHasItsTextbookArea) {
  const AreaProperties p = areaProperties(Polygon{{{0.0, 0.0}, {3.0, 0.0}, {0.0, 6.0}}});
  EXPECT_DOUBLE_EQ(p.area, 9.0);
  EXPECT_NEAR((p.centroid - Vec2(1.0, 2.0)).norm(), 0.0, 1e-14);
  EXPECT_NEAR(p.secondMoment, 9.0 * (9.0 + 36.0) / 18.0, 1e-12);  // bh(b² + h²)/36
}

TEST(Shape, AreaDoesNotLosePrecisionFarFromTheOrigin) {
  const AreaProperties p = areaProperties(makeBox(1.0, 1.0, Pose::at({1e6, -1e6}, 0.0)));
  EXPECT_NEAR(p.area, 1.0, 1e-9);
  EXPECT_NEAR(p.secondMoment, 1.0 / 6.0, 1e-9);
}

TEST(Shape, TwoHalvesHaveTheAreaOfTheWhole) {
  const AreaProperties whole = areaProperties(makeBox(2.0, 1.0));
  const AreaProperties halves =
      areaProperties({ConvexShape{makeBox(1.0, 1.0, Pose::at({-0.5, 0.0}, 0.0))},
                      ConvexShape{makeBox(1.0, 1.0, Pose::at({0.5, 0.0}, 0.0))}});
  EXPECT_NEAR(halves.area, whole.area, 1e-14);
  EXPECT_NEAR((halves.centroid - whole.centroid).norm(), 0.0, 1e-14);
  EXPECT_NEAR(halves.secondMoment, whole.secondMoment, 1e-14);
}

TEST(Shape, NoShapesHaveNoArea) { EXPECT_EQ(areaProperties(std::vector<ConvexShape>{}).area, 0.0); }

TEST(Shape, TransformedMovesEveryPoint) {
  const Pose pose = Pose::at({1.0, 2.0}, std::numbers::pi / 2.0);
  const auto box = std::get<Polygon>(transformed(makeBox(2.0, 4.0), pose));
  EXPECT_NEAR((box.vertices[0] - Vec2(3.0, 1.0)).norm(), 0.0, 1e-15);
  const auto disc = std::get<Circle>(transformed(Circle{{1.0, 0.0}, 0.5}, pose));
  EXPECT_NEAR((disc.center - Vec2(1.0, 3.0)).norm(), 0.0, 1e-15);
  EXPECT_EQ(disc.radius, 0.5);
}

}  // namespace
}  // namespace merge2d
