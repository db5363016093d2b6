/// Saved states of worlds that were changed between two steps.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "src2d/core/error.h"
#include "src2d/world.h"
#include "tests/src2d/world_edit_testing.h"
#include "tests/support/fingerprint.h"

namespace merge2d {
namespace {

TEST(EditedState, BodiesAddedBeforeTheFirstStepAreTheBodiesOfTheScene) {
  Scene whole = wall(4, 3);
  Scene part = whole;
  part.bodies.resize(whole.bodies.size() - 2);
  World expected(whole, {.timings = false}), world(part, {.timings = false});
  for (std::size_t i = part.bodies.size(); i < whole.bodies.size(); ++i) {
    world.addBody(whole.bodies[i]);
  }
  for (int i = 0; i < 200; ++i) {
    expected.step();
    world.step();
    ASSERT_TRUE(Fingerprint(world.capture()) == Fingerprint(expected.capture())) << "step " << i;
  }
}

/// Everything that a user can do, at some step each.
void meddle(World& world, int step) {
  if (step == 30) world.addBody(named("late", box(0.6, 0.6, {0.4, 5})));
  if (step == 60) world.setVelocity(BodyId{5}, {1, 2}, 0);
  if (step == 70) world.pin(BodyId{9});
  if (step == 80) {
    JointDesc rod = jointOf(JointKind::Distance, 5, 6, now(world, BodyId{5}).x);
    rod.to = now(world, BodyId{6}).x;
    world.addJoint(rod);
  }
  if (step == 90) world.addSpring(springOf(7, {0, 5}, 50, 5));
  if (step > 90 && step < 120) world.moveSpring(0, {0.05 * (step - 90), 5});
  if (step == 120) world.removeSpring(0);
  if (step == 130) world.unpin(BodyId{9});
  if (step == 140) world.removeBody(BodyId{3});
  if (step == 150) world.setGravity({1, -9});
  if (step == 160) world.removeJoint(1);
  if (step >= 170 && step < 180) world.applyForce(BodyId{2}, {0, 0.5}, {40, 0});
  if (step == 190) world.setPose(BodyId{8}, {0, 4}, 0.3);
  if (step == 200) world.setMode(Mode::Sleep);
  if (step == 215) world.setMode(Mode::MergeSleep);
}

TEST(EditedState, AMeddledRunContinuesFromASavedStateBitForBit) {
  const Scene scene = mixed();
  for (const int at : {31, 61, 71, 95, 121, 141, 165, 175, 195, 220}) {
    World whole(scene, {.timings = false});
    for (int i = 0; i < at; ++i) {
      meddle(whole, i);
      whole.step();
    }
    World resumed(scene, {.timings = false});
    if (whole.mode() != resumed.mode()) continue;
    resumed.setGravity(whole.gravity());
    resumed.restore(whole.save(), "test");
    EXPECT_EQ(resumed.save(), whole.save()) << at;
    EXPECT_EQ(resumed.bodies().size(), whole.bodies().size());
    for (int i = at; i < 260; ++i) {
      meddle(whole, i);
      meddle(resumed, i);
      whole.step();
      resumed.step();
      ASSERT_TRUE(Fingerprint(whole.capture()) == Fingerprint(resumed.capture()))
          << "from step " << at << ", step " << i;
    }
  }
}

TEST(EditedState, AWorldGoesBackToBeforeItWasMeddledWith) {
  World world(mixed(), {.timings = false});
  runSteps(world, 25);
  const std::string before = world.save();
  const Settings settings = world.settings();
  const auto follow = [&] {
    std::vector<Fingerprint> seen;
    for (int i = 0; i < 100; ++i) {
      world.step();
      seen.emplace_back(world.capture());
    }
    return seen;
  };
  const auto expected = follow();
  for (int i = 30; i < 195; ++i) {
    meddle(world, i);
    world.step();
  }
  world.setGravity({0, -9.81});
  world.setSettings(settings);
  world.restore(before, "test");
  EXPECT_EQ(world.save(), before);
  EXPECT_TRUE(follow() == expected);
}

TEST(EditedState, AStateIsTakenOverUnderOtherSettingsWhenThatIsAskedFor) {
  World world = atRest(3);
  const std::string bytes = world.save();
  World moon(column(3));
  moon.setGravity({0, -1.62});
  EXPECT_THROW(moon.restore(bytes, "test"), InputError);
  moon.restore(bytes, "test", SavedUnder::AnySettings);
  EXPECT_EQ(moon.gravity(), Vec2(0, -1.62));
  EXPECT_EQ(now(moon, BodyId{3}).x, now(world, BodyId{3}).x);

  World reference(column(3), {.mode = Mode::Reference});
  reference.restore(bytes, "test", SavedUnder::AnySettings);
  EXPECT_EQ(reference.mode(), Mode::Reference);
  EXPECT_TRUE(reference.capture().collections.empty());
  runSteps(reference, 100);
  EXPECT_NEAR(now(reference, BodyId{3}).x.y(), 2.5, 0.03);
}

}  // namespace
}  // namespace merge2d
