/// Changes of a world between two steps: they obey the laws of motion, and wake and unmerge the
/// bodies that they concern.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "src2d/core/error.h"
#include "src2d/world.h"
#include "tests/src2d/world_edit_testing.h"

namespace merge2d {
namespace {

using testing::HasSubstr;

TEST(WorldEdit, AForceActsForOneStep) {
  Scene scene = noGravity();
  add(scene, box(1, 1, {0, 0}));
  World world(scene);
  const BodyId body{0};
  world.applyForce(body, now(world, body).x, {3, 0});
  runSteps(world, 1);
  EXPECT_NEAR(now(world, body).v.x(), 3 * scene.step, 1e-15);
  runSteps(world, 10);
  EXPECT_NEAR(now(world, body).v.x(), 3 * scene.step, 1e-15);
}

TEST(WorldEdit, AForceBesideTheCentreOfMassTurnsTheBody) {
  Scene scene = noGravity();
  add(scene, box(2, 1, {0, 0}));
  World world(scene);
  world.applyForce(BodyId{0}, {1, 0}, {0, 5});
  runSteps(world, 1);
  const double inertia = 2.0 * 5.0 / 12.0;
  EXPECT_NEAR(now(world, BodyId{0}).omega, 5 * scene.step / inertia, 1e-12);
}

TEST(WorldEdit, ASteadyForceAboveFrictionMovesAMergedSleepingColumn) {
  World world = atRest(3);
  ASSERT_TRUE(now(world, kFirst).asleep);
  // 0.6 of the column's weight holds it.
  for (int i = 0; i < 100; ++i) {
    world.applyForce(kFirst, now(world, kFirst).x, {0.5 * 3 * kGravity, 0});
    world.step();
  }
  EXPECT_NEAR(now(world, kFirst).x.x(), 0.0, 0.01);
  for (int i = 0; i < 100; ++i) {
    world.applyForce(kFirst, now(world, kFirst).x, {0.9 * 3 * kGravity, 0});
    world.step();
  }
  EXPECT_GT(now(world, kFirst).x.x(), 0.3);
}

TEST(WorldEdit, AMemberThatIsGivenAVelocityComesFreeAndHasIt) {
  World world = atRest(3);
  world.setVelocity(BodyId{3}, {0, 5}, 0.5);
  EXPECT_EQ(now(world, BodyId{3}).v, Vec2(0, 5));
  EXPECT_EQ(now(world, BodyId{3}).omega, 0.5);
  EXPECT_EQ(now(world, BodyId{3}).collection, kNoCollection);
  const double y = now(world, BodyId{3}).x.y();
  runSteps(world, 50);
  const double t = 0.5, flight = 5 * t - 0.5 * kGravity * t * t;
  EXPECT_NEAR(now(world, BodyId{3}).x.y(), y + flight, 0.05);
  EXPECT_NEAR(now(world, BodyId{2}).x.y(), 1.5, 1e-2);
}

TEST(WorldEdit, ABodyThatIsPlacedElsewhereFallsFromThere) {
  World world = atRest(3);
  world.setPose(BodyId{3}, {10, 5}, 0.25);
  EXPECT_EQ(now(world, BodyId{3}).x, Vec2(10, 5));
  EXPECT_EQ(now(world, BodyId{3}).angle, 0.25);
  runSteps(world, 200);
  EXPECT_NEAR(now(world, BodyId{3}).x.y(), 0.5, 0.02);
}

TEST(WorldEdit, WhatStoodOnABodyThatIsPlacedElsewhereFalls) {
  World world = atRest(3);
  world.setPose(kFirst, {10, 0.5}, 0.0);
  runSteps(world, 200);
  EXPECT_NEAR(now(world, BodyId{2}).x.y(), 0.5, 0.02);
  EXPECT_NEAR(now(world, BodyId{3}).x.y(), 1.5, 0.02);
}

TEST(WorldEdit, WhatIsPlacedInsideAMergedPileIsPushedOut) {
  World world = atRest(3);
  world.setPose(BodyId{0}, {0, -0.3}, 0.0);  // the ground rises
  runSteps(world, 300);
  EXPECT_NEAR(now(world, kFirst).x.y(), 0.7, 0.02);
  EXPECT_NEAR(now(world, BodyId{3}).x.y(), 2.7, 0.03);
}

TEST(WorldEdit, APinnedBodyStaysAndAnUnpinnedOneFalls) {
  World world = atRest(2);
  world.setPose(BodyId{2}, {5, 8}, 0.0);
  world.pin(BodyId{2});
  runSteps(world, 50);
  EXPECT_EQ(now(world, BodyId{2}).x, Vec2(5, 8));
  EXPECT_TRUE(now(world, BodyId{2}).pinned);
  world.unpin(BodyId{2});
  runSteps(world, 50);
  EXPECT_NEAR(now(world, BodyId{2}).x.y(), 8 - 0.5 * kGravity * 0.25, 0.05);
}

/// Its contact with the ground outlived the pin, and made it a member.
TEST(WorldEdit, ABodyThatIsPinnedWhereItLiesIsNoMember) {
  World world(column(2), {.mode = Mode::Merge});
  runSteps(world, 100);
  world.pin(kFirst);
  runSteps(world, 50);
  EXPECT_EQ(now(world, kFirst).collection, kNoCollection);
  EXPECT_NE(now(world, BodyId{2}).collection, kNoCollection) << "which stands on it";
  world.unpin(kFirst);
  world.setVelocity(kFirst, {0, 3}, 0.0);
  runSteps(world, 5);
  EXPECT_GT(now(world, kFirst).x.y(), 0.55);
}

/// A step that ends with an error between two stages may leave a collection that has come apart and
/// is not laid out.
TEST(WorldEdit, AWorldWhoseStepFailedCanBeChanged) {
  for (const bool removes : {false, true}) {
    Scene scene = wall(8, 10);
    scene.settings.merging.rule = MergingRule::Paper;
    scene.settings.unmerging.rule = UnmergingRule::Paper;
    add(scene, box(0.5, 0.5, {-30, 20}));
    const BodyId flying{static_cast<std::uint32_t>(scene.bodies.size() - 1)};
    const BodyId top{static_cast<std::uint32_t>(scene.bodies.size() - 2)};
    World world(scene, {.mode = Mode::Merge});
    runSteps(world, 100);
    const Snapshot seen = world.capture();
    world.applyImpulse(top, of(seen, top).x, {20000, 6000});
    for (int i = 0; i < 3; ++i) world.applyImpulse(flying, of(seen, flying).x, {1.7e308, 0});
    EXPECT_THROW(world.step(), SimulationError);
    if (removes) {
      world.removeBody(kFirst);
    } else {
      world.release(kFirst);
    }
  }
}

TEST(WorldEdit, WhatStoodOnAGroundThatIsUnpinnedFallsWithIt) {
  World world = atRest(3);
  world.unpin(BodyId{0});
  runSteps(world, 50);
  const double fall = 0.5 * kGravity * 0.25;
  EXPECT_NEAR(now(world, BodyId{0}).x.y(), -0.5 - fall, 0.05);
  EXPECT_NEAR(now(world, kFirst).x.y(), 0.5 - fall, 0.05);
}

TEST(WorldEdit, ARemovedBodyLeavesWhatStoodOnItToFall) {
  World world = atRest(3);
  world.removeBody(kFirst);
  EXPECT_EQ(world.capture().bodies.size(), 3u);
  runSteps(world, 150);
  EXPECT_NEAR(now(world, BodyId{2}).x.y(), 0.5, 0.02);
  EXPECT_THROW(now(world, kFirst), std::runtime_error);
}

TEST(WorldEdit, ARemovedBodyTakesItsSpringsAndJointsAlong) {
  Scene scene = onGround();
  add(scene, box(1, 1, {0, 5}));
  add(scene, box(1, 1, {2, 5}));
  add(scene, box(1, 1, {5, 5}));
  scene.joints.push_back(jointOf(JointKind::Weld, 1, 2, {1, 5}));
  scene.springs.push_back(springOf(3, {0, 0}, 10, 0));
  scene.springs.back().to_body = 1;
  World world(scene);
  runSteps(world, 5);
  world.removeBody(kFirst);
  const Snapshot before = world.capture();
  runSteps(world, 20);
  const Snapshot after = world.capture();
  for (const BodyId free : {BodyId{2}, BodyId{3}}) {
    EXPECT_EQ(of(after, free).v.x(), of(before, free).v.x());
    EXPECT_EQ(of(after, free).omega, of(before, free).omega);
  }
  EXPECT_TRUE(world.capture().springs.empty());
}

TEST(WorldEdit, AnAddedBodyFallsOnWhatSleepsAndStays) {
  World world = atRest(3);
  const BodyId added = world.addBody(named("new", box(1, 1, {0, 3.8})));
  EXPECT_EQ(added, BodyId{4});
  EXPECT_EQ(world.bodies().at(4).name, "new");
  EXPECT_NEAR(now(world, added).x.y(), 3.8, 1e-11);
  runSteps(world, 200);
  EXPECT_NEAR(now(world, added).x.y(), 3.5, 0.03);
  EXPECT_NE(now(world, added).collection, kNoCollection);
}

TEST(WorldEdit, WhatIsMergedStaysMergedAsBodiesAreAdded) {
  World world = atRest(3);
  const Snapshot before = world.capture();
  world.addBody(box(1, 1, {20, 9}));
  const Snapshot after = world.capture();
  ASSERT_EQ(after.collections.size(), before.collections.size());
  for (std::uint32_t i = 1; i <= 3; ++i) {
    EXPECT_EQ(of(after, BodyId{i}).x, of(before, BodyId{i}).x);
    EXPECT_EQ(of(after, BodyId{i}).collection, of(before, BodyId{i}).collection);
  }
}

TEST(WorldEdit, TheReferenceHasNoCollectionsAndMergesAgainAfterwards) {
  World world = atRest(3);
  world.setMode(Mode::Reference);
  EXPECT_TRUE(world.capture().collections.empty());
  runSteps(world, 50);
  EXPECT_NEAR(now(world, BodyId{3}).x.y(), 2.5, 0.03);
  EXPECT_FALSE(now(world, BodyId{3}).asleep);
  world.setMode(Mode::MergeSleep);
  runSteps(world, 100);
  EXPECT_FALSE(world.capture().collections.empty());
  EXPECT_TRUE(now(world, BodyId{3}).asleep);
}

TEST(WorldEdit, ASpringThatFollowsAPlaceDragsItsBody) {
  World world = atRest(1);
  const std::uint32_t drag = world.addSpring(springOf(1, {0, 0.5}, 200, 25));
  for (int i = 1; i <= 200; ++i) {
    world.moveSpring(drag, {0.01 * i, 3});
    world.step();
  }
  runSteps(world, 300);
  EXPECT_NEAR(now(world, kFirst).x.x(), 2.0, 0.01);
  EXPECT_NEAR(now(world, kFirst).x.y(), 3 - kGravity / 200, 0.01);
  world.removeSpring(drag);
  runSteps(world, 200);
  EXPECT_NEAR(now(world, kFirst).x.y(), 0.5, 0.02);
}

TEST(WorldEdit, WhatSleepsFeelsANewGravity) {
  World world = atRest(2);
  world.setGravity({0, 3});
  runSteps(world, 100);
  EXPECT_NEAR(now(world, BodyId{2}).x.y(), 1.5 + 0.5 * 3, 0.1);
}

TEST(WorldEdit, AJointHoldsBodiesAsTheyStandWhenItIsAdded) {
  World world = atRest(2);
  world.setPose(BodyId{2}, {0.2, 4}, 0.3);
  world.addJoint(jointOf(JointKind::Weld, 2, std::nullopt, {0.2, 4}));
  runSteps(world, 100);
  EXPECT_NEAR(now(world, BodyId{2}).x.y(), 4, 1e-3);
  EXPECT_NEAR(now(world, BodyId{2}).angle, 0.3, 1e-3);
  world.removeJoint(0);
  runSteps(world, 20);
  EXPECT_LT(now(world, BodyId{2}).x.y(), 3.9);
}

TEST(WorldEdit, TheFirstBodyWakesWhenItsJointToTheWorldIsRemoved) {
  Scene scene;
  add(scene, box(1, 1, {0, 2}));
  scene.joints.push_back(jointOf(JointKind::Revolute, 0, std::nullopt, {0, 2.5}));
  World world(scene);
  runSteps(world, 100);
  ASSERT_TRUE(now(world, BodyId{0}).asleep);
  world.removeJoint(0);
  runSteps(world, 20);
  EXPECT_LT(now(world, BodyId{0}).x.y(), 1.9);
}

TEST(WorldEdit, ArraysSayWhatASnapshotSays) {
  World world(mixed());
  runSteps(world, 60);
  const std::size_t n = world.bodies().size();
  std::vector<double> poses(3 * n), velocities(3 * n);
  std::vector<std::int32_t> collections(n);
  world.poses(poses);
  world.velocities(velocities);
  world.collections(collections);
  const Snapshot seen = world.capture();
  ASSERT_LT(seen.bodies.size(), n) << "some are still to come";
  EXPECT_TRUE(std::isnan(poses.back()));
  EXPECT_EQ(collections.back(), -1);
  for (const BodyState& body : seen.bodies) {
    const std::size_t i = index(body.id);
    EXPECT_EQ(Vec2(poses[3 * i], poses[3 * i + 1]), body.x);
    EXPECT_EQ(poses[3 * i + 2], body.angle);
    EXPECT_EQ(Vec2(velocities[3 * i], velocities[3 * i + 1]), body.v);
    EXPECT_EQ(velocities[3 * i + 2], body.omega);
    EXPECT_EQ(collections[i], value(body.collection));
  }
  EXPECT_THROW(world.poses(velocities = std::vector<double>(5)), InputError);
}

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(WorldEdit, WhatCannotBeIsRefused) {
  Scene scene = column(2);
  add(scene, named("lift", scripted(box(1, 1, {9, 9}), SteadyMotion{})));
  World world(scene);
  const double nan = std::nan("");
  EXPECT_EQ(refusal([&] {
              world.applyForce(BodyId{7}, {0, 0}, {1, 0});
            }),
            "there is no body 7: the world has 4");
  EXPECT_EQ(refusal([&] {
              world.applyImpulse(BodyId{4}, {0, 0}, {1, 0});
            }),
            "there is no body 4: the world has 4");
  EXPECT_EQ(refusal([&] { world.setPose(BodyId{1}, {nan, 0}, 0); }), "a pose must be finite");
  EXPECT_EQ(refusal([&] {
              world.setPose(BodyId{3}, {0, 0}, 0);
            }),
            "body 'lift' moves by its script");
  EXPECT_EQ(refusal([&] {
              world.setVelocity(BodyId{0}, {0, 0}, 0);
            }),
            "body 'ground' is pinned: it has no velocity");
  world.removeBody(BodyId{2});
  EXPECT_THAT(refusal([&] { world.wake(BodyId{2}); }), HasSubstr("is not in the world now"));
  EXPECT_EQ(refusal([&] { world.removeSpring(0); }), "there is no spring 0");
  EXPECT_EQ(refusal([&] {
              world.addJoint(jointOf(JointKind::Weld, 1, 1, {0, 0}));
            }),
            "the joint: a joint needs two bodies, or one and the world");
}

TEST(WorldEdit, DescriptionsAreCheckedInTheWordsOfAFile) {
  World world(column(2));
  BodyDesc heavy = named("heavy", box(1, 1, {5, 5}));
  heavy.mass = -1.0;
  EXPECT_EQ(refusal([&] { world.addBody(heavy); }),
            "'mass' in body 'heavy' must be positive (1e-12 to 1e12), but is -1.0");
  SpringDesc spring = springOf(1, {0, 5}, 50, 5);
  spring.stiffness = std::nan("");
  EXPECT_THAT(refusal([&] { world.addSpring(spring); }),
              HasSubstr("'stiffness' in the spring must be a finite number"));
  Settings settings = world.settings();
  settings.solver.iterations = 0;
  EXPECT_THAT(refusal([&] { world.setSettings(settings); }),
              HasSubstr("'iterations' in [solver] must be between 1 and 1000000, but is 0"));
  EXPECT_EQ(world.settings().solver.iterations, Settings{}.solver.iterations);
  JointDesc joint = jointOf(JointKind::Distance, 1, 2, {0, 0});
  joint.length = -1.0;
  EXPECT_THAT(refusal([&] { world.addJoint(joint); }), HasSubstr("'length' in the joint must be"));
}

}  // namespace
}  // namespace merge2d
