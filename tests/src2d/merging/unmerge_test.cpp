#include "src2d/merging/unmerge.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "src2d/collections/cuts.h"
#include "src2d/state_file.h"
#include "tests/support/merging_testing.h"
#include "tests/support/modes_and_steps.h"

namespace merge2d {
namespace {

const std::string kSixBoxes = kGround + R"(
[[body]]
name = "box"
at = [0, 0.5]
box = [1, 1]
repeat = { count = [1, 6], spacing = [1, 1] }
)";

std::string boxName(int row) { return "box[0," + std::to_string(row) + "]"; }

TEST(Unmerge, FreesOnlyTheBodyThatWasHit) {
  Simulation run(kSixBoxes, Mode::Merge);
  run.until(3.0);
  const CollectionId pile = run.collectionOf(boxName(0));
  ASSERT_EQ(run.collectionOf(boxName(5)), pile);
  run.kick(boxName(5), {0.0, 2.0});
  run.steps(1);
  EXPECT_FALSE(run.merged(boxName(5)));
  EXPECT_EQ(events(run, EventType::Unmerge, EventReason::Broken), 1);
  for (int row = 0; row < 5; ++row) EXPECT_EQ(run.collectionOf(boxName(row)), pile) << row;
  EXPECT_NEAR(run.body(boxName(5)).v.y(), 2.0 - 9.81 * 0.01, 1e-9);
}

TEST(Unmerge, ABreakInTheMiddleLeavesTwoParts) {  // Figure 3
  Simulation run(kSixBoxes, Mode::Merge);
  run.until(3.0);
  const CollectionId pile = run.collectionOf(boxName(0));
  ASSERT_EQ(run.collectionOf(boxName(5)), pile);
  run.kick(boxName(3), {0.0, 6.0});  // throws boxes 3, 4 and 5 up by 2 m/s
  run.steps(1);
  const CollectionId upper = run.collectionOf(boxName(3));
  for (int row = 0; row < 3; ++row) EXPECT_EQ(run.collectionOf(boxName(row)), pile) << row;
  EXPECT_NE(upper, pile);
  for (int row = 3; row < 6; ++row) {
    EXPECT_EQ(run.collectionOf(boxName(row)), upper) << row;
    EXPECT_NEAR(run.body(boxName(row)).v.y(), 2.0 - 9.81 * 0.01, 0.02) << row;
  }
  for (int row = 0; row < 3; ++row) EXPECT_NEAR(run.body(boxName(row)).v.norm(), 0.0, 1e-9);
}

// ---- forces ----

/// The step in which a tall box on the ground leaves its collection when it is pushed from 1 s on.
int stepOfTipping(Mode mode, double push, const Overrides& rule = {}) {
  Simulation run(kGround + R"(
[[body]]
name = "box"
at = [0, 1]
box = [0.5, 2]
[[force]]
body = "box"
at = [-0.25, 1]
from = 1
force = [)" + std::to_string(push) +
                     ", 0]\n",
                 mode, rule);
  for (int step = 1; step <= 400; ++step) {
    run.steps(1);
    if (step >= 100 && !run.merged("box")) return step;
  }
  return -1;
}

TEST(Unmerge, APushThatTipsABoxIsFeltInTheStepInWhichItBegins) {
  for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {  // it takes 1.23 N
    EXPECT_EQ(stepOfTipping(mode, 1.35), 101) << name(mode);
    EXPECT_EQ(stepOfTipping(mode, 1.1), -1) << name(mode);
  }
}

TEST(Unmerge, UnderThePapersRuleAPushThatTipsABoxIsFeltStepsLater) {
  EXPECT_EQ(stepOfTipping(Mode::Merge, 1.35, kPaper), 114);
}

// ---- impacts ----

TEST(Unmerge, AProjectileMovesAsManyBodiesAsInTheReference) {
  const int iterations = SolverSettings{}.iterations;
  for (const Vec2& velocity : {Vec2(10.0, 1.0), Vec2(20.0, 1.0), Vec2(30.0, 8.0)}) {
    const int reference = movedByBall(Mode::Reference, velocity, 100);  // which has converged
    EXPECT_GT(reference, 5);
    EXPECT_NEAR(movedByBall(Mode::MergeSleep, velocity, iterations), reference, 0.3 * reference)
        << "at " << velocity.x() << " m/s";
  }
}

// ---- no flicker ----

TEST(Unmerge, AWeldThatBrokeAtOnceDoesNotFormAtOnce) {
  // A box is knocked as soon as it has merged, and comes to rest again within a few steps.
  const auto stepsApart = [](const Overrides& overrides) {
    Simulation run(kGround + R"(
[[body]]
name = "box"
at = [0, 0.5]
box = [1, 1]
)",
                   Mode::Merge, overrides);
    std::int64_t parted = 0, again = 0;
    bool kicked = false;
    run.steps(100, [&] {
      const bool merged = run.merged("box");
      const std::int64_t step = run.world().steps();
      if (merged && !kicked) run.kick("box", {0.1, 0.0}, {0.0, -0.4});
      if (!merged && kicked && parted == 0) parted = step;
      if (merged && parted > 0 && again == 0) again = step;
      kicked |= merged;
    });
    EXPECT_GT(parted, 0);
    EXPECT_GT(again, parted);
    return again - parted;
  };
  EXPECT_GE(stepsApart({}), 20);
  EXPECT_LT(stepsApart(kPaper), 15);
}

int wallEvents(const Scene& scene) {
  Simulation run(scene, Mode::Merge);
  run.until(5.0);
  const int before = run.count(EventType::Merge) + run.count(EventType::Unmerge);
  EXPECT_GT(before, 0);
  EXPECT_LE(run.world().stats().active_bodies, 2) << "all is merged";
  run.until(15.0);
  return run.count(EventType::Merge) + run.count(EventType::Unmerge) - before;
}

TEST(Unmerge, AWallOnTheGroundDoesNotFlicker) { EXPECT_EQ(wallEvents(wall(18, 18)), 0); }

/// Partings in the first ten seconds of a wall that merges while it sinks in.
int partingsOfASettlingWall(MergingRule merging, UnmergingRule unmerging) {
  Scene scene = wall(18, 18);
  scene.settings.merging.rule = merging;
  scene.settings.unmerging.rule = unmerging;
  Simulation run(scene, Mode::Merge);
  run.until(10.0);
  return run.count(EventType::Unmerge);
}

TEST(Unmerge, UnderThePapersRulesAWallPartsWhileItSettles) {
  EXPECT_NEAR(partingsOfASettlingWall(MergingRule::Default, UnmergingRule::Default), 8, 5);
  EXPECT_NEAR(partingsOfASettlingWall(MergingRule::Paper, UnmergingRule::Default), 150, 15);
  EXPECT_NEAR(partingsOfASettlingWall(MergingRule::Default, UnmergingRule::Paper), 163, 15);
  EXPECT_NEAR(partingsOfASettlingWall(MergingRule::Paper, UnmergingRule::Paper), 390, 30);
}

TEST(Unmerge, AWallOnASwingingPlatformDoesNotFlicker) {
  EXPECT_EQ(wallEvents(wallOnSwingingPlatform(18, 18, 0.4, 10.0)), 0);
}

// ---- release ----

/// A plank on two blocks, all merged with the ground.
const std::string kPlankOnTwo = kGround + R"(
[[body]]
name = "left"
at = [-1, 0.5]
box = [1, 1]
[[body]]
name = "right"
at = [1, 0.5]
box = [1, 1]
[[body]]
name = "plank"
at = [0, 1.1]
box = [3, 0.2]
)";

/// The other block goes; the plank stays on the one whose weld was marked, but not parted, in an
/// earlier step.
void releaseTheRightBlock(const Overrides& rule) {
  const Scene scene = parseScene(kPlankOnTwo, "test.toml", rule);
  World world(scene, {.mode = Mode::Merge, .timings = false});
  while (world.time() < 2.0) world.step();
  merge2d::Setup setup;
  setUp(scene, Mode::Merge, setup);
  restoreState(world.save(), "world", scene, setup);
  State& state = setup.state;
  Scratch scratch;
  const BodyId left = idOf(world, "left"), right = idOf(world, "right"),
               plank = idOf(world, "plank");
  const auto between = [&](const Weld& weld) { return weld.a == left && weld.b == plank; };
  ASSERT_TRUE(stillTogether(state, left, plank));
  Collection& c = state.collection(state[plank].rigid);
  const auto weld = std::ranges::find_if(c.welds, between);
  ASSERT_NE(weld, c.welds.end());
  weld->cut = true;
  weld->reason = EventReason::Sliding;
  releaseBodies(state, scratch, {right});
  EXPECT_FALSE(stillTogether(state, plank, right));
  EXPECT_TRUE(stillTogether(state, left, plank));
  EXPECT_EQ(state[left].rigid, state[plank].rigid);
  for (const Event& e : scratch.events) EXPECT_EQ(e.reason, EventReason::User);
  EXPECT_EQ(scratch.events.size(), 2U) << "from the ground and from the plank";
}

TEST(Unmerge, ReleasingABodyBreaksNoWeldForAMarkOfAnEarlierStep) {
  releaseTheRightBlock({});
  releaseTheRightBlock(kPaper);
}

/// The speed that the last of a row gets from a box that comes at 3 m/s, when the row has merged
/// with the ground or sleeps [m/s]. Each is `heavier` times as heavy as the one before it.
double passedAlongARow(double restitution, double heavier, Mode mode, double h) {
  constexpr int kRow = 5;
  Scene scene = onGround();
  for (int i = 0; i <= kRow; ++i) {
    BodyDesc body = box(0.5, 0.5, {i == 0 ? -3.913 : 0.501 * i, 0.25});
    body.mass = std::pow(heavier, i);
    body.restitution = restitution;
    body.friction = i == 0 ? 0.0 : 0.01;
    body.velocity.x() = i == 0 ? 3.0 : 0.0;
    add(scene, body);
  }
  scene.bodies[0].friction = 0.01;
  scene.step = h;
  World world(scene, inMode(mode));
  double fastest = 0.0;
  while (world.time() < 2.0) {
    world.step();
    fastest = std::max(fastest, see(world, BodyId{kRow + 1}).v.x());
  }
  return fastest;
}

/// Each passes on (1 + e) m₁ / (m₁ + m₂) of its speed, or more when it is hit again: as in the
/// reference. Friction takes μ g h from each of the six in the step in which it is hit, and in the
/// one after it.
TEST(Unmerge, AllAreFreedThatABounceReaches) {
  for (const double restitution : {0.3, 0.5, 0.8, 1.0}) {
    for (const double heavier : {1.0, 0.7, 1.4}) {
      SCOPED_TRACE(::testing::Message() << "e = " << restitution << ", masses " << heavier);
      for (const double h : kStepSizes) {
        const double reference = passedAlongARow(restitution, heavier, Mode::Reference, h);
        EXPECT_GT(reference, 3.0 * std::pow((1.0 + restitution) / (1.0 + heavier), 5) - 0.1);
        for (const Mode mode : {Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
          EXPECT_NEAR(passedAlongARow(restitution, heavier, mode, h), reference,
                      12.0 * 0.01 * kGravity * h)
              << nameOf(mode) << ", h = " << h;
        }
      }
    }
  }
}

}  // namespace
}  // namespace merge2d
