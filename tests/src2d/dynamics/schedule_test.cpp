/// Bodies that are let go and forces that begin at their times, whatever happens to the world
/// between.

#include "src2d/dynamics/schedule.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace merge2d {
namespace {

/// Bodies that are let go in another order than they are listed, and a push that begins and ends.
Scene timed() {
  Scene scene;
  const double times[] = {0.6, 0.2, 0.4, 0.2};
  for (int i = 0; i < 4; ++i) {
    BodyDesc body = box(1, 1, {2.0 * i, 10});
    body.pinned_until = times[i];
    add(scene, body);
  }
  scene.forces.push_back({.body = 3, .force = {5, 0}, .from = 0.7, .until = 0.8});
  scene.forces.push_back({.body = 1, .force = {5, 0}, .from = 0.3, .until = 0.9});
  scene.forces.push_back({.body = 1, .force = {0, 3}, .from = 0.3, .until = 0.35});
  return scene;
}

TEST(PinnedUntil, AWorldThatWentBackLetsItsBodiesGoOnceMore) {
  World world = reference(timed());
  std::vector<std::string> seen;
  for (int i = 0; i < 100; ++i) {
    seen.push_back(world.save());
    world.step();
  }
  const std::string end = world.save();
  for (const std::size_t back : {95U, 75U, 40U, 32U, 10U, 0U}) {
    world.restore(seen[back], "memory");
    runSteps(world, 100 - static_cast<int>(back));
    EXPECT_TRUE(world.save() == end) << back;
  }
}

TEST(PinnedUntil, ABodyThatIsAddedLaterFallsAtItsTimeToo) {
  World world = reference(timed());
  runSeconds(world, 0.5);
  BodyDesc late = box(1, 1, {-5, 10}), overdue = late;
  late.pinned_until = 0.7;
  overdue.at = {-8, 10};
  overdue.pinned_until = 0.3;
  const BodyId a = world.addBody(late), b = world.addBody(overdue);
  runSteps(world, 1);
  EXPECT_TRUE(see(world, a).pinned);
  EXPECT_FALSE(see(world, b).pinned);
  runSeconds(world, 0.25);
  EXPECT_FALSE(see(world, a).pinned);
  EXPECT_FALSE(see(world, BodyId{0}).pinned);
}

TEST(Force, EndsAtItsTimeAlsoWhereTheStepChangesMeanwhile) {
  World world = reference(timed());
  runSeconds(world, 0.5);
  world.setTimeStep(0.02);
  runSteps(world, 30);
  const double gained = 5.0 * 0.1;  // of 1 kg
  EXPECT_NEAR(see(world, BodyId{3}).v.x(), gained, 1e-12);
  EXPECT_NEAR(see(world, BodyId{1}).v.x(), 5.0 * 0.6, 1e-12);
}

}  // namespace
}  // namespace merge2d
