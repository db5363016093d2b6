/// Post-step stabilisation: positions are corrected, velocities know nothing of it.

#include "src2d/dynamics/stabilise.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace merge2d {
namespace {

const Overrides kPost{{"solver.stabilisation", "post"}};

const std::string kDeepBox = R"(
format = 1
gravity = [0, 0]
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [10, 1]
[[body]]
name = "crate"
at = [0, 0.4]
box = [1, 1]
)";

TEST(Stabilise, AnOverlapGoesWithoutAVelocity) {
  World world = reference(parseScene(kDeepBox, "s.toml", kPost));
  for (int i = 0; i < 20; ++i) {
    world.step();
    EXPECT_NEAR(world.capture().bodies[1].v.norm(), 0.0, 1e-12);
  }
  EXPECT_NEAR(world.capture().bodies[1].x.y(), 0.5, 1e-4);
}

TEST(Stabilise, BaumgartePushesInstead) {
  World world = reference(parseScene(kDeepBox, "s.toml"));
  world.step();
  EXPECT_GT(world.capture().bodies[1].v.y(), 0.1);
}

TEST(Stabilise, AColumnStandsWithoutOverlap) {
  const std::string column = R"(
format = 1
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [10, 1]
[[body]]
name = "box"
at = [0, 0.5]
box = [1, 1]
repeat = { count = [1, 10], spacing = [1, 1] }
)";
  World world = reference(parseScene(column, "s.toml", kPost));
  runSeconds(world, 4.0);
  const Snapshot now = world.capture();
  for (const BodyState& body : now.bodies) EXPECT_LT(body.v.norm(), 1e-3);
  EXPECT_LT(now.stats.max_penetration, 1e-4);
  EXPECT_NEAR(now.bodies.back().x.y(), 9.5, 1e-2);
}

TEST(Stabilise, JointsAreCorrectedToo) {
  const std::string pendulum = R"(
format = 1
[[body]]
name = "bob"
at = [1, 0]
circle = 0.1
[[joint]]
kind = "revolute"
bodies = ["bob"]
at = [0, 0]
)";
  World world = reference(parseScene(pendulum, "s.toml", kPost));
  for (int i = 0; i < 400; ++i) {
    world.step();
    ASSERT_NEAR(world.capture().bodies[0].x.norm(), 1.0, 5e-3) << i;
  }
}

/// How many bodies of the spinner, at so many degrees per second, are in a collection after 5 s.
int mergedInTheSpinner(const char* spin, const Overrides& overrides) {
  Overrides all{{"body.tray.script.spin", spin}};
  all.insert(all.end(), overrides.begin(), overrides.end());
  World world(loadScene("spinner", all), inMode(Mode::Merge));
  runSeconds(world, 5.0);
  int merged = 0;
  for (const BodyState& body : world.capture().bodies) merged += body.collection != kNoCollection;
  return merged;
}

TEST(Stabilise, AFastSpinnerMergesOnlyWithIt) {
  for (const char* spin : {"150", "240"}) {
    EXPECT_EQ(mergedInTheSpinner(spin, {}), 0);
    EXPECT_EQ(mergedInTheSpinner(spin, kPost), 4);
  }
}

TEST(Stabilise, OrWithATenthOfTheStep) {
  EXPECT_EQ(mergedInTheSpinner("150", {{"step", "0.001"}}), 4);
}

}  // namespace
}  // namespace merge2d
