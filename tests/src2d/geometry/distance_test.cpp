#include "src2d/geometry/distance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace merge2d {
namespace {

Collider boxOf(double width, double height) { return Collider(makeBox(width, height)); }
Collider discOf(double radius) {
  return Collider(Circle{.center = Vec2::Zero(), .radius = radius});
}

void expectNearest(const Collider& a, const Collider& b, const Pose& b_in_a, double distance,
                   const Vec2& normal) {
  const Nearest found = nearest(a, b, b_in_a);
  EXPECT_NEAR(found.distance, distance, 1e-12);
  EXPECT_NEAR((found.normal - normal).norm(), 0.0, 1e-12);
  const Nearest back = nearest(b, a, b_in_a.inverse());
  EXPECT_NEAR(back.distance, distance, 1e-12);
  EXPECT_NEAR((b_in_a.rotation * back.normal + normal).norm(), 0.0, 1e-12);
}

TEST(Distance, OfDiscsIsThatOfTheirCentresLessTheRadii) {
  expectNearest(discOf(0.5), discOf(0.25), Pose::at({3, 4}, 0.3), 4.25, {0.6, 0.8});
}

TEST(Distance, OfADiscFromABoxIsThatFromItsFaceOrCorner) {
  expectNearest(boxOf(2, 2), discOf(0.5), Pose::at({0.3, 2}, 1.0), 0.5, {0, 1});
  expectNearest(boxOf(2, 2), discOf(0.5), Pose::at({4, 5}, 0.0), 4.5, {0.6, 0.8});
}

TEST(Distance, OfBoxesIsThatOfFacesOrCorners) {
  expectNearest(boxOf(2, 2), boxOf(1, 1), Pose::at({2.5, 0.7}, 0.0), 1.0, {1, 0});
  expectNearest(boxOf(2, 2), boxOf(2, 2), Pose::at({5, 6}, 0.0), 5.0, {0.6, 0.8});
  const double half = std::sqrt(0.5);  // of a unit box that stands on its corner
  expectNearest(boxOf(2, 2), boxOf(1, 1), Pose::at({2, 0.2}, std::atan(1.0)), 1.0 - half, {1, 0});
}

TEST(Distance, IsZeroWhereTheyOverlap) {
  EXPECT_EQ(nearest(boxOf(2, 2), boxOf(1, 1), Pose::at({1.2, 0}, 0.5)).distance, 0.0);
  EXPECT_EQ(nearest(boxOf(2, 2), boxOf(0.1, 0.1), Pose::at({0.1, 0.2}, 0.5)).distance, 0.0);
  EXPECT_EQ(nearest(boxOf(2, 2), discOf(0.1), Pose::at({0.1, 0.2}, 0.5)).distance, 0.0);
  EXPECT_EQ(nearest(discOf(1), discOf(0.1), Pose::at({0.5, 0}, 0)).distance, 0.0);
}

TEST(Distance, ReachIsTheFarthestVertexOrADiscsCentre) {
  EXPECT_DOUBLE_EQ(reachFrom(boxOf(6, 8), Vec2::Zero()), 5.0);
  EXPECT_DOUBLE_EQ(reachFrom(discOf(1.0), Vec2(0, 2)), 2.0);
}

}  // namespace
}  // namespace merge2d
