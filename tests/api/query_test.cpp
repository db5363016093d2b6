/// Which bodies are at a point, in a box, in a shape or on a ray.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <merge2d/merge2d.h>

#include "api_testing.h"

namespace {

using merge2d::Scene;
using merge2d::Shape;
using merge2d::World;
using merge2d::testing_api::towerOf;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(PublicQueries, QueriesSeeBodiesWhereTheyAreNow) {
  World world(towerOf(3));
  EXPECT_THAT(world.at({0.2, 0.5}), ElementsAre(1));
  EXPECT_THAT(world.at({5.0, 5.0}), IsEmpty());
  EXPECT_THAT(world.inBox({-0.1, 0.9}, {0.1, 1.1}), ElementsAre(1, 2));
  EXPECT_THAT(world.touching(Shape::circle(0.3), {0.7, 2.5}), ElementsAre(3));
  EXPECT_THAT(world.touching(Shape::circle(0.1), {0.7, 2.5}), IsEmpty());
  world.setPose(2, {7.0, 1.5}, 0.0);
  EXPECT_THAT(world.at({7.0, 1.5}), ElementsAre(2));
  EXPECT_THAT(world.at({0.0, 1.5}), IsEmpty());
}

TEST(PublicQueries, ABoxQueryDoesNotTakeTheBoxAroundABodyForTheBody) {
  Scene scene;
  scene.add({.shapes = {Shape::circle(1.0)}});
  World world(scene);
  EXPECT_THAT(world.inBox({0.8, 0.8}, {1.0, 1.0}), IsEmpty());
  EXPECT_THAT(world.inBox({0.6, 0.6}, {1.0, 1.0}), ElementsAre(0));
}

TEST(PublicQueries, ARayMeetsTheFirstBodyOnItsWay) {
  World world(towerOf(3));
  const auto hit = world.castRay({-10.0, 1.5}, {10.0, 1.5});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->body, 2U);
  EXPECT_NEAR(hit->point.x, -0.5, 1e-9);
  EXPECT_NEAR(hit->fraction, 9.5 / 20.0, 1e-9);
  EXPECT_NEAR(hit->normal.x, -1.0, 1e-9);
  EXPECT_EQ(hit->collection, world.collectionOf(2));
  EXPECT_FALSE(world.castRay({-10.0, 50.0}, {10.0, 50.0}));
  EXPECT_FALSE(world.castRay({-10.0, 1.5}, {-0.6, 1.5})) << "it ends before";
  const auto inside = world.castRay({0.0, 1.5}, {10.0, 1.5});
  ASSERT_TRUE(inside);
  EXPECT_EQ(inside->body, 2U);
  EXPECT_EQ(inside->fraction, 0.0);
}

TEST(PublicQueries, ARayMeetsACircleOnItsOutline) {
  Scene scene;
  scene.add({.position = {3.0, 4.0}, .shapes = {Shape::circle(2.0)}});
  World world(scene);
  const auto hit = world.castRay({0.0, 0.0}, {6.0, 8.0});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->fraction, 0.3, 1e-9);
  EXPECT_NEAR(hit->normal.x, -0.6, 1e-9);
  EXPECT_NEAR(hit->normal.y, -0.8, 1e-9);
}

}  // namespace
