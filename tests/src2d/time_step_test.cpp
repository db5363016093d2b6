/// Time steps whose length changes while a world runs.

#include "src2d/time_step.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "src2d/core/error.h"
#include "src2d/world.h"
#include "tests/src2d/world_edit_testing.h"
#include "tests/support/fingerprint.h"

namespace merge2d {
namespace {

/// The normal forces on a body, upwards and downwards [N].
double carried(const World& world, BodyId body) {
  double sum = 0.0;
  for (const auto& contact : world.capture().contacts) {
    if (contact.a == body || contact.b == body) sum += contact.lambda_n;
  }
  return sum / world.timeStep();
}

TEST(TimeStep, ABodyFallsAsTheSchemeSaysBeforeAndAfterAChange) {
  Scene scene;
  add(scene, disc(0.1, {0, 50}));
  World world(scene);
  runSteps(world, 40);
  world.setTimeStep(0.0025);
  runSteps(world, 200);
  // Symplectic Euler: each step moves by its last velocity, so n steps of h make g h² n (n + 1)
  // / 2.
  const double fall_1 = kGravity * 0.01 * 0.01 * 40 * 41 / 2, v_1 = kGravity * 0.4;
  const double fall_2 = v_1 * 0.5 + kGravity * 0.0025 * 0.0025 * 200 * 201 / 2;
  EXPECT_NEAR(now(world, BodyId{0}).x.y(), 50 - fall_1 - fall_2, 1e-9);
  EXPECT_NEAR(now(world, BodyId{0}).v.y(), -kGravity * 0.9, 1e-12);
}

TEST(TimeStep, TimeAddsUpTheStepsAsLongAsTheyWere) {
  World world(column(1));
  runSteps(world, 10);
  world.setTimeStep(0.02);
  runSteps(world, 5);
  world.setTimeStep(0.001);
  runSteps(world, 100);
  EXPECT_EQ(world.steps(), 115);
  EXPECT_NEAR(world.time(), 0.1 + 0.1 + 0.1, 1e-12);
  EXPECT_NEAR(world.capture().time, world.time(), 0.0);
  EXPECT_EQ(world.timeStep(), 0.001);
  EXPECT_EQ(world.scene().step, 0.01) << "the scene stays as it was";
}

TEST(TimeStep, WhatHappensAtATimeHappensAtThatTime) {
  Scene scene = noGravity();
  add(scene, disc(0.5, {0, 0}));
  ImpulseDesc blow;
  blow.impulse = {1, 0};
  blow.time = 0.5;
  scene.impulses.push_back(blow);
  World world(scene);
  runSteps(world, 20);  // to 0.2 s
  world.setTimeStep(0.005);
  runSteps(world, 60);
  EXPECT_EQ(now(world, BodyId{0}).v.x(), 0.0) << world.time();
  world.step();
  EXPECT_NEAR(now(world, BodyId{0}).v.x(), 1.0 / world.bodies()[0].mass, 1e-12);
}

TEST(TimeStep, AScriptedBodyKeepsToItsSchedule) {
  Scene scene;
  add(scene, scripted(box(1, 1, {0, 0}), Sinusoid{.axis = {1, 0}, .amplitude = 1, .period = 2}));
  World world(scene);
  runSteps(world, 25);
  world.setTimeStep(0.003);
  runSteps(world, 100);
  EXPECT_NEAR(now(world, BodyId{0}).x.x(), 1.0 - std::cos(std::numbers::pi * 0.55), 1e-9);
}

/// A column under way in each mode: the forces that it stands by last, and nothing parts or moves.
class ColumnAtRest : public ::testing::TestWithParam<std::tuple<Mode, double>> {};

TEST_P(ColumnAtRest, StandsOnUnderTheSameForces) {
  const auto [mode, h] = GetParam();
  World world(column(6), {.mode = mode});
  runSteps(world, 150);
  const double weight = world.bodies()[1].mass * kGravity;
  const BodyId top{6}, second{5};
  ASSERT_NEAR(carried(world, top), weight, 0.02 * weight);
  const std::size_t collections = world.capture().collections.size();
  world.setTimeStep(h);
  EXPECT_NEAR(carried(world, top), weight, 0.02 * weight) << "right after the change";
  double highest = 0.0;
  for (int i = 0; i < 100; ++i) {
    world.step();
    const Snapshot seen = world.capture();
    EXPECT_EQ(seen.collections.size(), collections) << "step " << i;
    for (const Event& event : seen.events) {
      EXPECT_NE(event.type, EventType::Unmerge) << "step " << i;
    }
    for (const BodyState& body : seen.bodies) highest = std::max(highest, body.v.norm());
  }
  // The soft contacts of the reference settle to the overlap of the new step, from n weights each:
  // |C λ_new − C λ_old| adds up to at most 3/2 of the sum over 6 contacts. Merged bodies stay.
  const double softness = 0.009 * kGravity * 0.01 * (2 * (1 + 2 + 3 + 4 + 5) + 6);
  EXPECT_LT(highest, mode == Mode::Reference ? 1.5 * softness : 1e-3);
  EXPECT_NEAR(carried(world, top), weight, 0.02 * weight);
  EXPECT_NEAR(carried(world, second), 3 * weight, 0.06 * weight) << "2 weights below, 1 above";
}
INSTANTIATE_TEST_SUITE_P(Modes, ColumnAtRest,
                         ::testing::Combine(::testing::Values(Mode::Reference, Mode::Merge,
                                                              Mode::MergeSleep),
                                            ::testing::Values(0.005, 0.02)));

TEST(TimeStep, WhatSleepsWakesAndSleepsAgain) {
  World world = atRest(4);
  ASSERT_EQ(world.stats().active_bodies, 0);
  world.setTimeStep(0.005);
  world.step();
  EXPECT_GT(world.stats().active_bodies, 0);
  runSteps(world, 400);
  EXPECT_EQ(world.stats().active_bodies, 0);
}

TEST(TimeStep, ASpinningPairThatHasMergedKeepsItsMomentumAndItsBond) {
  Scene scene = noGravity();
  BodyDesc left = box(1, 1, {-0.5, 0}), right = box(1, 1, {0.5, 0});
  add(scene, left);
  add(scene, right);
  scene.joints.push_back(jointOf(JointKind::Weld, 0, 1, {0, 0}));
  for (BodyDesc& body : scene.bodies) body.spin = 1.0;
  scene.bodies[0].velocity = {0, -0.5};
  scene.bodies[1].velocity = {0, 0.5};
  World world(scene, {.mode = Mode::Merge});
  runSteps(world, 50);
  ASSERT_EQ(world.capture().collections.size(), 1U);
  for (const double h : {0.005, 0.02, 0.01}) {
    world.setTimeStep(h);
    for (int i = 0; i < 50; ++i) {
      world.step();
      ASSERT_EQ(world.capture().collections.size(), 1U) << "h = " << h << ", step " << i;
    }
    EXPECT_NEAR(now(world, BodyId{0}).omega, 1.0, 1e-6);
  }
}

TEST(TimeStep, ItIsPartOfASavedState) {
  const Scene scene = mixed();
  World whole(scene, {.timings = false});
  runSteps(whole, 60);
  whole.setTimeStep(0.004);
  runSteps(whole, 30);
  World resumed(scene, {.timings = false});
  EXPECT_THROW(resumed.restore(whole.save(), "test"), InputError) << "of another step";
  resumed.setTimeStep(0.004);
  resumed.restore(whole.save(), "test");
  EXPECT_EQ(resumed.time(), whole.time());
  EXPECT_EQ(resumed.save(), whole.save());
  for (int i = 0; i < 100; ++i) {
    whole.step();
    resumed.step();
    ASSERT_TRUE(Fingerprint(whole.capture()) == Fingerprint(resumed.capture())) << "step " << i;
  }
}

TEST(TimeStep, AStateIsTakenOverByAWorldOfOtherSteps) {
  World world = atRest(3);
  World finer(column(3));
  finer.setTimeStep(0.002);
  finer.restore(world.save(), "test", SavedUnder::AnySettings);
  EXPECT_EQ(finer.timeStep(), 0.002);
  EXPECT_EQ(finer.time(), world.time());
  EXPECT_NEAR(carried(finer, BodyId{3}), carried(world, BodyId{3}), 1e-9);
  runSteps(finer, 100);
  EXPECT_NEAR(finer.time(), world.time() + 0.2, 1e-12);
  EXPECT_NEAR(now(finer, BodyId{3}).x.y(), 2.5, 0.01);
}

TEST(TimeStep, TheSameLengthChangesNothing) {
  World one(mixed(), {.timings = false}), other(mixed(), {.timings = false});
  for (int i = 0; i < 120; ++i) {
    one.step();
    other.setTimeStep(0.01);
    other.step();
    ASSERT_TRUE(Fingerprint(one.capture()) == Fingerprint(other.capture())) << "step " << i;
  }
}

TEST(TimeStep, OthersThanFilesMayHaveAreRefused) {
  World world(column(1));
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const double h : {0.0, -0.01, 1e-7, 1.5, none, -none}) {
    try {
      world.setTimeStep(h);
      ADD_FAILURE() << h;
    } catch (const InputError& error) {
      const char* range = std::isfinite(h) ? "between 1e-6 and 1 s" : "a finite number";
      EXPECT_THAT(error.what(), ::testing::HasSubstr("'step'"));
      EXPECT_THAT(error.what(), ::testing::HasSubstr(range));
    }
    EXPECT_EQ(world.timeStep(), 0.01);
  }
}

}  // namespace
}  // namespace merge2d
