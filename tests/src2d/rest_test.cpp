/// A world at rest: its steps take no time, and are missed by nobody.

#include "src2d/rest.h"

#include <gtest/gtest.h>

#include <functional>
#include <numeric>

#include "src2d/world.h"
#include "tests/src2d/world_edit_testing.h"

namespace merge2d {
namespace {

struct Twins : WatchedTwins {
  using WatchedTwins::WatchedTwins;
  /// Runs both, and compares all that matters for the steps to come.
  void run(int steps) {
    for (int i = 0; i < steps; ++i) {
      step();
      ASSERT_EQ(one.events().size(), watched.events().size()) << "step " << one.steps();
      ASSERT_EQ(one.stats().asleep, watched.stats().asleep) << "step " << one.steps();
    }
    ASSERT_TRUE(one.save() == watched.save()) << "step " << one.steps();
  }
};

/// A wall, a compound body, a lamp on a damped spring, and a cart that stops after a second.
Scene still() {
  Scene scene = wall(3, 3);
  BodyDesc tee = box(0.2, 1, {-6, 0.5});
  tee.shapes.emplace_back(makeBox(1, 0.2, Pose::at({0, 0.4}, 0)));
  add(scene, named("tee", tee));
  add(scene, named("lamp", disc(0.2, {-9, 2})));
  scene.springs.push_back(springOf(scene.bodies.size() - 1, {-9, 4}, 40, 4));
  Keyframes way;
  way.keys = {{0.0, {9, -0.5}, 0.0}, {1.0, {9.2, -0.5}, 0.0}};
  add(scene, named("cart", scripted(box(4, 1, {9, -0.5}), way)));
  scene.bodies[0] = named("ground", pinned(box(16, 1, {-2, -0.5})));
  addColumn(scene, 2, {9, 0});
  return scene;
}

/// Of the stages behind the first one, which has the time of the start of a step too.
double secondsOfStages(const World& world) {
  const auto& seconds = world.stats().seconds;
  return std::accumulate(seconds.begin() + 1, seconds.end(), 0.0);
}

TEST(Rest, NoStageRunsWhereEverythingSleeps) {
  for (const Mode mode : {Mode::Sleep, Mode::MergeSleep}) {
    World world(still(), {.mode = mode});
    runSeconds(world, 20.0);
    ASSERT_EQ(world.stats().active_bodies, 0);
    EXPECT_EQ(secondsOfStages(world), 0.0);
    const std::int64_t steps = world.steps();
    world.step();
    EXPECT_EQ(world.steps(), steps + 1);
    EXPECT_EQ(secondsOfStages(world), 0.0);
    world.wake(BodyId{1});
    world.step();
    EXPECT_GT(secondsOfStages(world), 0.0);
  }
}

TEST(Rest, NoStepIsLeftOutWhereSomethingMoves) {
  Scene scene = still();
  SteadyMotion turning;
  turning.spin = 0.1;
  add(scene, scripted(disc(0.5, {30, 0}), turning));
  World world(scene, {.mode = Mode::MergeSleep});
  runSeconds(world, 20.0);
  ASSERT_EQ(world.stats().active_bodies, 0);
  EXPECT_GT(secondsOfStages(world), 0.0);
}

TEST(Rest, AScheduledActionComesInTime) {
  Scene scene = still();
  ImpulseDesc blow;
  blow.body = 2;
  blow.time = 15.0;
  blow.at = {0, 0.5};
  blow.impulse = {2, 0};
  scene.impulses.push_back(blow);
  ForceDesc push;
  push.body = 4;
  push.from = 25.0;
  push.until = 25.5;
  push.force = {3, 0};
  scene.forces.push_back(push);
  EmitterDesc rain{.body = named("drop", disc(0.2, {1, 6}))};
  rain.start = 35.0;
  rain.every = 1.0;
  rain.count = 2;
  scene.emitters.push_back(rain);
  for (const Mode mode : {Mode::Sleep, Mode::MergeSleep}) {
    Twins twins(scene, mode);
    for (int i = 0; i < 45; ++i) twins.run(100);
  }
}

TEST(Rest, EveryChangeFromOutsideIsFelt) {
  const BodyId brick{5};
  const std::vector<std::function<void(World&)>> changes = {
      [&](World& w) {
        w.applyImpulse(brick, {0, 2}, {1, 0});
      },
      [&](World& w) {
        w.applyForce(brick, {0, 2}, {500, 0});
      },
      [&](World& w) {
        w.setPose(brick, {0, 8}, 0.2);
      },
      [&](World& w) {
        w.setVelocity(brick, {1, 1}, 1.0);
      },
      [&](World& w) { w.pin(brick); },
      [&](World& w) { w.unpin(BodyId{0}); },
      [&](World& w) { w.release(brick); },
      [&](World& w) { w.setFriction(brick, 0.0); },
      [&](World& w) { w.wake(brick); },
      [&](World& w) {
        w.addBody(disc(0.3, {0, 6}));
      },
      [&](World& w) { w.removeBody(BodyId{1}); },
      [&](World& w) {
        w.addSpring(springOf(3, {3, 9}, 50, 1));
      },
      [&](World& w) {
        w.moveSpring(0, {-9, 5});
      },
      [&](World& w) { w.removeSpring(0); },
      [&](World& w) {
        w.addJoint(jointOf(JointKind::Revolute, 3, std::nullopt, {0, 5}));
      },
      [&](World& w) {
        w.setGravity({1, -9});
      },
      [&](World& w) { w.setMode(Mode::Reference); },
      [&](World& w) {
        Settings settings = w.settings();
        settings.sleeping.velocity = 1e-12;
        w.setSettings(settings);
      },
  };
  for (const Mode mode : {Mode::Sleep, Mode::MergeSleep}) {
    for (std::size_t i = 0; i < changes.size(); ++i) {
      SCOPED_TRACE("change " + std::to_string(i));
      Twins twins(still(), mode);
      twins.run(1500);
      twins.change(changes[i]);
      twins.run(100);
    }
  }
}

TEST(Rest, ARestoredWorldGoesOnFromWhatIsRestored) {
  World world(still(), {.mode = Mode::MergeSleep});
  const std::string start = world.save();
  runSeconds(world, 20.0);
  const std::string end = world.save();
  world.restore(start, "the start");
  runSeconds(world, 20.0);
  EXPECT_TRUE(world.save() == end);
}

}  // namespace
}  // namespace merge2d
