#include "src2d/sleeping/sleep.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

const std::string kTwoPiles = kGround + R"(
[[body]]
name = "left"
at = [-5, 0.5]
box = [1, 1]
repeat = { count = [2, 3], spacing = [1.02, 1] }
[[body]]
name = "right"
at = [5, 0.5]
box = [1, 1]
repeat = { count = [2, 3], spacing = [1.02, 1] }
)";

bool asleep(const Simulation& run, const std::string& prefix) {
  const Snapshot now = run.now();
  bool all = true;
  for (const BodyState& b : now.bodies) {
    if (run.world().bodies()[index(b.id)].name.starts_with(prefix)) all &= b.asleep;
  }
  return all;
}
bool anyAsleep(const Simulation& run, const std::string& prefix) {
  const Snapshot now = run.now();
  return std::any_of(now.bodies.begin(), now.bodies.end(), [&](const BodyState& b) {
    return b.asleep && run.world().bodies()[index(b.id)].name.starts_with(prefix);
  });
}

TEST(Sleep, APileFallsAsleepAndThenCostsNothing) {
  for (const Mode mode : {Mode::MergeSleep, Mode::Sleep}) {
    Simulation run(kTwoPiles, mode);
    run.until(10.0);
    EXPECT_TRUE(asleep(run, "left"));
    EXPECT_TRUE(asleep(run, "right"));
    const Stats stats = run.now().stats;
    EXPECT_EQ(stats.asleep, 12);
    EXPECT_EQ(stats.active_bodies, 0);
    EXPECT_EQ(stats.contacts, 0);
    EXPECT_EQ(stats.internal_contacts, 0);
  }
}

/// On hard contacts they stop within a step of landing, and are at rest for long enough to sleep
/// before they have merged. Asleep they would be asked nothing any more.
TEST(Sleep, WaitsForWhatIsAboutToMerge) {
  std::string toml = kGround;
  for (int i = 0; i < 60; ++i) {
    toml += fmt::format("[[body]]\nname = \"box{}\"\nat = [{}, {}]\nbox = [0.2, 0.2]\n", i,
                        3 * i - 90, 0.1 + 0.03 * i);
  }
  Simulation run(toml, Mode::MergeSleep, {{"solver.compliance", "1e-6"}});
  run.until(3.0);
  for (int i = 0; i < 60; ++i) {
    EXPECT_TRUE(run.body(fmt::format("box{}", i)).asleep) << i;
    EXPECT_TRUE(run.merged(fmt::format("box{}", i))) << i;
  }
}

TEST(Sleep, NothingSleepsInTheModesWithoutSleep) {
  for (const Mode mode : {Mode::Reference, Mode::Merge}) {
    Simulation run(kTwoPiles, mode);
    run.steps(500, [&] { ASSERT_EQ(run.world().stats().asleep, 0); });
  }
}

TEST(Sleep, ASleepingPileDoesNotMove) {
  Simulation run(kTwoPiles, Mode::MergeSleep);
  run.until(10.0);
  const Snapshot before = run.now();
  run.steps(200);
  EXPECT_EQ(moved(before, run.now(), 0.0), 0);
}

TEST(Sleep, OnlyTheIslandThatIsHitWakes) {
  for (const Mode mode : {Mode::MergeSleep, Mode::Sleep}) {
    Simulation run(kTwoPiles, mode);
    run.until(10.0);
    ASSERT_TRUE(asleep(run, "left") && asleep(run, "right"));
    run.kick("left[0,2]", {1.0, 0.0});
    run.steps(1);
    EXPECT_FALSE(asleep(run, "left"));
    EXPECT_TRUE(asleep(run, "right"));
    run.steps(100, [&] { ASSERT_TRUE(asleep(run, "right")); });
    EXPECT_GT(run.body("left[0,2]").x.x(), -5.0);
  }
}

TEST(Sleep, ABodyThatLandsOnAPileWakesIt) {
  Simulation run(kTwoPiles + R"(
[[body]]
name = "falling"
at = [-5, 6]
box = [1, 1]
pinned_until = 10
)",
                 Mode::MergeSleep);
  run.until(10.0);
  ASSERT_TRUE(asleep(run, "left"));
  bool woke = false;
  run.steps(200, [&] {
    woke |= !asleep(run, "left");
    ASSERT_TRUE(asleep(run, "right"));
  });
  EXPECT_TRUE(woke);
  run.until(25.0);
  EXPECT_TRUE(asleep(run, "left") && asleep(run, "falling")) << "all sleep again";
}

TEST(Sleep, ScriptedMotionBelowWakesThePile) {
  Simulation run(R"(
format = 1
[[body]]
name = "platform"
motion = "scripted"
box = [12, 1]
script = { keyframes = [[10, 0, -0.5, 0], [14, 2, -0.5, 0]] }
[[body]]
name = "pile"
at = [0, 0.5]
box = [1, 1]
repeat = { count = [2, 2], spacing = [1.02, 1] }
)",
                 Mode::MergeSleep);
  run.until(9.9);
  ASSERT_TRUE(asleep(run, "pile"));
  const double before = run.body("pile[0,1]").x.x();
  run.until(10.5);
  EXPECT_FALSE(anyAsleep(run, "pile"));
  run.until(14.0);
  EXPECT_NEAR(run.body("pile[0,1]").x.x() - before, 2.0, 1e-3);
}

TEST(Sleep, WhatRestsOnAMovingPlatformDoesNotSleep) {
  Simulation run(R"(
format = 1
[[body]]
name = "platform"
motion = "scripted"
at = [0, -0.5]
box = [12, 1]
script = { velocity = [0.5, 0] }
[[body]]
name = "pile"
at = [0, 0.5]
box = [1, 1]
velocity = [0.5, 0]
repeat = { count = [1, 3], spacing = [1, 1] }
)",
                 Mode::MergeSleep);
  run.steps(600, [&] { ASSERT_FALSE(anyAsleep(run, "pile")); });
  EXPECT_TRUE(run.merged("pile[0,2]"));
  EXPECT_NEAR(seenFrom(run.body("platform"), run.body("pile[0,2]")).position.x(), 0.0, 1e-3);
}

TEST(Sleep, ABallAtTheTopOfItsFlightStaysAwake) {
  Simulation run(R"(
format = 1
[[body]]
name = "ball"
circle = 0.5
velocity = [0, 9.81]
)",
                 Mode::MergeSleep);
  run.steps(200, [&] { ASSERT_FALSE(run.body("ball").asleep); });
}

TEST(Sleep, AForceThatSetsInWakesASleeper) {
  Simulation run(kTwoPiles + R"(
[[force]]
body = "right[0,2]"
force = [20, 0]
from = 10
)",
                 Mode::MergeSleep);
  run.until(9.9);
  ASSERT_TRUE(asleep(run, "right"));
  const double before = run.body("right[0,2]").x.x();
  run.until(10.5);
  EXPECT_GT(run.body("right[0,2]").x.x(), before + 0.1);
  EXPECT_TRUE(asleep(run, "left"));
}

TEST(Sleep, ASleeperWhoseSupportIsTakenAwayFalls) {
  Simulation run(kGround + R"(
[[body]]
name = "support"
at = [0, 0.5]
box = [1, 1]
[[body]]
name = "upper"
at = [0, 1.5]
box = [1, 1]
friction = 0.1
)",
                 Mode::MergeSleep);
  run.until(8.0);
  ASSERT_TRUE(asleep(run, "upper"));
  run.kick("support", {12.0, 0.0}, {0.0, -0.3});
  run.until(10.0);
  EXPECT_LT(run.body("upper").x.y(), 1.0);
}

TEST(Sleep, EachWakeFollowsASleep) {
  Simulation run(kTwoPiles, Mode::MergeSleep);
  int wakes_early = 0;
  run.steps(1500, [&] {
    for (const Event& e : run.world().events()) {
      wakes_early += e.type == EventType::Wake && run.world().steps() < 1000;
    }
    if (run.world().steps() == 1000) run.kick("left[1,2]", {2.0, 0.0});
  });
  EXPECT_EQ(wakes_early, 0) << "a pile at rest does not flicker";
  EXPECT_GT(run.count(EventType::Wake), 0);
  EXPECT_LE(run.count(EventType::Wake), run.count(EventType::Sleep));
}

}  // namespace
}  // namespace merge2d
