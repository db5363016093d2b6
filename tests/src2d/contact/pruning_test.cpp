/// Two points per flat region of a pair of bodies, and those that these do not stand for.

#include <gtest/gtest.h>

#include "src2d/contact/detection.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

/// A beam 5 m wide on `teeth` teeth, whose feet are at y = 0.
BodyDesc comb(int teeth) {
  BodyDesc body;
  body.shapes = {makeBox(5, 0.5, Pose::at({0, 1.25}, 0.0))};
  for (int i = 0; i < teeth; ++i) {
    const double x = -2.4 + 4.8 * i / (teeth - 1);
    body.shapes.push_back(makeBox(0.2, 1, Pose::at({x, 0.5}, 0.0)));
  }
  return body;
}

TEST(Pruning, AConcaveBodyOnTheFloorRestsOnItsOutermostTwoPoints) {
  for (const int teeth : {2, 3, 6, 12}) {
    Scene scene = onGround();
    add(scene, comb(teeth));
    World world = reference(scene);
    runSteps(world, 200);
    const auto contacts = world.capture().contacts;
    ASSERT_EQ(contacts.size(), 2u) << teeth << " teeth";
    EXPECT_NEAR(std::abs(contacts[0].x.x()), 2.5, 1e-3);
    EXPECT_NEAR(contacts[0].x.x() + contacts[1].x.x(), 0.0, 1e-3);
    EXPECT_LT(fastest(world), 1e-6);
  }
}

/// A point between the outermost two was dropped however deep it was.
TEST(Pruning, AToothThatIsALittleLongerBears) {
  constexpr double kLonger = 0.004;  // m
  BodyDesc body = comb(3);
  body.shapes[2] = makeBox(0.2, 1 + kLonger, Pose::at({0, 0.5 * (1 - kLonger)}, 0.0));
  Scene scene = onGround();
  add(scene, body);
  World world = reference(scene);
  const double start = see(world, BodyId{1}).x.y();
  runSteps(world, 200);
  EXPECT_NEAR(see(world, BodyId{1}).x.y() - start, kLonger, 0.001);
  EXPECT_LT(fastest(world), 1e-6);
}

TEST(Pruning, AFloorOfManyTilesIsOneFlatRegion) {
  Scene scene;
  BodyDesc floor;
  floor.shapes.clear();
  for (int i = 0; i < 10; ++i) floor.shapes.push_back(makeBox(1, 1, Pose::at({i - 4.5, -0.5}, 0)));
  add(scene, pinned(floor));
  add(scene, box(4, 1, {0.3, 0.5}));
  World world = reference(scene);
  runSteps(world, 100);
  const auto contacts = world.capture().contacts;
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_NEAR(std::abs(contacts[0].x.x() - contacts[1].x.x()), 4.0, 1e-3);
}

TEST(Pruning, ABoxSlidesOverTheJointsOfATiledFloorAsOverOnePlate) {
  const auto stop = [](const std::vector<ConvexShape>& shapes) {
    Scene scene;
    BodyDesc floor;
    floor.shapes = shapes;
    add(scene, pinned(floor));
    add(scene, box(1, 0.5, {-4, 0.25}));
    scene.bodies[1].velocity = {6, 0};
    World world = reference(scene);
    runSeconds(world, 2);
    return see(world, BodyId{1});
  };
  std::vector<ConvexShape> tiles;
  for (int i = 0; i < 14; ++i) tiles.push_back(makeBox(1, 1, Pose::at({i - 6.5, -0.5}, 0)));
  const BodyState tiled = stop(tiles);
  const BodyState plate = stop({makeBox(14, 1, Pose::at({0, -0.5}, 0))});
  EXPECT_NEAR(tiled.x.x(), plate.x.x(), 0.01);
  EXPECT_NEAR(tiled.x.y(), plate.x.y(), 1e-3);
}

TEST(Pruning, RegionsAtDifferentHeightsAndAnglesKeepTheirOwnPoints) {
  Scene scene;
  BodyDesc step;  // two treads
  step.shapes = {makeBox(2, 1, Pose::at({-1, -0.5}, 0)), makeBox(2, 2, Pose::at({1, 0}, 0))};
  add(scene, pinned(step));
  BodyDesc bridge;  // a foot on each
  bridge.shapes = {makeBox(4, 0.5, Pose::at({0, 2.25}, 0)), makeBox(0.5, 2, Pose::at({-1.5, 1}, 0)),
                   makeBox(0.5, 1, Pose::at({1.5, 1.5}, 0))};
  add(scene, bridge);
  World world = reference(scene);
  runSteps(world, 100);
  EXPECT_EQ(world.capture().contacts.size(), 4u);
}

TEST(Pruning, TheTwoBodiesOfAPairShareTheirPointsNotThoseOfOthers) {
  Scene scene = onGround();
  add(scene, comb(4));
  add(scene, box(1, 1, {0, 2.0}));
  World world = reference(scene);
  runSteps(world, 100);
  EXPECT_EQ(world.capture().contacts.size(), 4u);
}

}  // namespace
}  // namespace merge2d
