/// A body that sleeps for long is in no list of the stages, and nobody can tell.

#include "src2d/contact/parking.h"

#include <gtest/gtest.h>

#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "src2d/trace/trace_writer.h"
#include "src2d/world.h"
#include "tests/src2d/world_edit_testing.h"

namespace merge2d {
namespace {

/// All that can be seen of a world without waking its lists.
std::vector<double> seen(const World& world) {
  const std::size_t bodies = world.bodies().size();
  std::vector<double> numbers(6 * bodies);
  world.poses(std::span(numbers).first(3 * bodies));
  world.velocities(std::span(numbers).last(3 * bodies));
  std::vector<std::int32_t> collections(bodies);
  world.collections(collections);
  numbers.insert(numbers.end(), collections.begin(), collections.end());
  for (double& number : numbers) {
    if (std::isnan(number)) number = -1e300;  // a body that is not there
  }
  const Stats& stats = world.stats();
  for (const int count : {stats.bodies, stats.active_bodies, stats.asleep, stats.collections,
                          stats.contacts, stats.internal_contacts}) {
    numbers.push_back(count);
  }
  for (const Event& event : world.events()) {
    numbers.push_back(static_cast<double>(event.type));
    numbers.push_back(static_cast<double>(event.a));
  }
  return numbers;
}

/// Nothing is parked in the one that is watched.
struct Pair : WatchedTwins {
  using WatchedTwins::WatchedTwins;
  void run(int steps) {
    for (int i = 0; i < steps; ++i) {
      step();
      ASSERT_TRUE(seen(one) == seen(watched)) << "step " << one.steps();
    }
  }
};

constexpr Mode kSleeping[] = {Mode::Sleep, Mode::MergeSleep};

/// Stacks and a wall beside a lamp that swings for ever, and a cart that goes after ten seconds.
Scene manyAsleep() {
  Scene scene = onGround();
  for (int i = 0; i < 6; ++i) addColumn(scene, 3, {2.0 * i, 0});
  addWall(scene, 3, 4, {-8, 0});
  BodyDesc tee = box(0.2, 1, {-14, 0.5});
  tee.shapes.emplace_back(makeBox(1, 0.2, Pose::at({0, 0.4}, 0)));
  add(scene, named("tee", tee));
  Keyframes way;
  way.keys = {{10.0, {19, 0.5}, 0.0}, {12.0, {11.5, 0.5}, 0.0}};
  add(scene, named("cart", scripted(box(2, 1, {19, 0.5}), way)));
  addColumn(scene, 2, {19, 1});
  add(scene, named("lamp", disc(0.3, {-20, 6})));
  scene.springs.push_back(springOf(scene.bodies.size() - 1, {-19, 9}, 200, 0));
  return scene;
}

TEST(Parking, WhatActsOnASleeperWakesAllThatItMoves) {
  const BodyId kGround{0};
  const BodyId box{2};  // in the middle of the first stack
  const std::vector<std::function<void(World&)>> changes = {
      [&](World& w) {
        w.applyImpulse(box, {0, 1.5}, {1, 0});
      },
      [&](World& w) {
        w.applyForce(box, {0, 1.5}, {400, 0});
      },
      [&](World& w) {
        w.setPose(box, {0, 8}, 0.2);
      },
      [&](World& w) { w.removeBody(BodyId{1}); },
      [&](World& w) { w.wake(box); },
      [&](World& w) {
        w.setVelocity(box, {0.5, 0}, 0.1);
      },
      [&](World& w) { w.pin(box); },
      [&](World& w) { w.release(box); },
      [&](World& w) { w.setFriction(box, 0.1); },
      [&](World& w) { w.release(kGround); },
      [&](World& w) { w.setFriction(kGround, 0.1); },
      [&](World& w) {
        w.setPose(kGround, {0.5, -0.5}, 0.0);
      },
      [&](World& w) { w.unpin(kGround); },
      [&](World& w) { w.removeBody(kGround); },
      [&](World& w) {
        w.addBody(disc(0.3, {0.3, 7}));
      },
      [&](World& w) {
        w.addSpring(springOf(2, {3, 9}, 50, 1));
      },
      [&](World& w) {
        w.addJoint(jointOf(JointKind::Revolute, 3, std::nullopt, {0, 5}));
      },
      [&](World& w) {
        w.setGravity({1, -9});
      },
      [&](World& w) {
        w.moveSpring(0, {-14, 5});  // the lamp comes to the tee
      },
  };
  for (const Mode mode : kSleeping) {
    for (std::size_t i = 0; i < changes.size(); ++i) {
      SCOPED_TRACE("change " + std::to_string(i));
      Pair pair(manyAsleep(), mode);
      pair.run(300);
      ASSERT_GT(pair.one.stats().asleep, 20);
      pair.change(changes[i]);
      pair.run(300);
      EXPECT_TRUE(pair.one.save() == pair.watched.save());
    }
  }
}

/// Shelves that let go one after the other, each with a stack on it, and magnets that begin to
/// hold.
TEST(Parking, AShelfThatFallsWakesItsOwnStackAlone) {
  Scene scene = manyAsleep();
  for (int i = 0; i < 3; ++i) {
    BodyDesc shelf = box(1.5, 0.5, {30.0 + 3.0 * i, 2.75});
    shelf.pinned_until = 6.0 - 0.5 * i;
    add(scene, named("shelf" + std::to_string(i), shelf));
    addColumn(scene, 2, {30.0 + 3.0 * i, 3});
  }
  for (const BodyIndex magnet : {BodyIndex{0}, BodyIndex{2}}) {
    scene.magnets.push_back({.body = magnet, .on = {{7.0, 8.0}}});
  }
  for (const Mode mode : kSleeping) {
    Pair pair(scene, mode);
    pair.run(1000);
    EXPECT_TRUE(pair.one.save() == pair.watched.save());
  }
}

JointDesc rodBetween(BodyIndex a, std::optional<BodyIndex> b, const Vec2& at, const Vec2& to) {
  JointDesc rod = jointOf(JointKind::Distance, a, b, at);
  rod.to = to;
  return rod;
}

/// Boxes that rods hold together: a row on the ground, a pair that hangs down from the world, boxes
/// on the ground that hang together with a post and with a cart far away, and a stack on the cart,
/// which goes after ten seconds. The lamp swings for ever.
Scene joinedAsleep() {
  Scene scene = onGround();
  for (int i = 0; i < 4; ++i) add(scene, box(1, 1, {2.0 * i, 0.5}));  // 1 to 4
  add(scene, box(0.4, 1, {-4, 6}));                                   // 5
  add(scene, box(0.4, 1, {-4, 4.5}));                                 // 6
  add(scene, pinned(box(0.5, 0.5, {-7, 8})));                         // 7
  add(scene, box(1, 1, {-7, 0.5}));                                   // 8
  add(scene, box(1, 1, {14, 0.5}));                                   // 9
  Keyframes way;
  way.keys = {{10.0, {22, 0.5}, 0.0}, {12.0, {24, 0.5}, 0.0}};
  add(scene, named("cart", scripted(box(2, 1, {22, 0.5}), way)));  // 10
  addColumn(scene, 2, {22, 1});                                    // 11, 12
  add(scene, named("lamp", disc(0.3, {-20, 6})));                  // 13
  scene.springs.push_back(springOf(scene.bodies.size() - 1, {-19, 9}, 200, 0));
  for (BodyIndex i = 1; i < 4; ++i) {
    const double x = 2.0 * static_cast<double>(i - 1);
    scene.joints.push_back(rodBetween(i, i + 1, {x, 0.5}, {x + 2, 0.5}));
  }
  scene.joints.push_back(jointOf(JointKind::Weld, 5, std::nullopt, {-4, 6.5}));
  scene.joints.push_back(jointOf(JointKind::Weld, 5, 6, {-4, 5.25}));
  scene.joints.push_back(rodBetween(7, 8, {-7, 8}, {-7, 0.5}));
  scene.joints.push_back(rodBetween(9, 10, {14, 0.5}, {22, 0.5}));
  add(scene, box(1, 1, {40, 0.5}));     // 14
  add(scene, box(0.4, 1, {-12, 8.5}));  // 15
  scene.joints.push_back(jointOf(JointKind::Weld, 14, 0, {40, 0}));
  scene.joints.push_back(jointOf(JointKind::Revolute, 15, std::nullopt, {-12, 9}));
  return scene;
}

TEST(Parking, WhatActsOnOneWakesAllThatJointsHoldTogether) {
  const BodyId kFirst{1}, kLower{6}, kPost{7}, kTied{9};
  const std::vector<std::function<void(World&)>> changes = {
      [&](World& w) {
        w.applyImpulse(kFirst, {0, 0.5}, {-900, 0});
      },
      [&](World& w) {
        w.applyImpulse(kLower, {-4, 4.5}, {100, 0});
      },
      [&](World& w) {
        w.setPose(kPost, {-7, 8.5}, 0.0);
      },
      [&](World& w) { w.unpin(kPost); },
      [&](World& w) { w.removeBody(kPost); },
      [&](World& w) { w.removeBody(BodyId{2}); },
      [&](World& w) { w.removeBody(BodyId{14}); },  // which a weld holds to the ground
      [&](World& w) { w.removeBody(kTied); },
      [&](World& w) { w.removeJoint(1); },
      [&](World& w) { w.removeJoint(3); },
      [&](World& w) { w.removeJoint(6); },
      [&](World& w) {
        w.setVelocity(kTied, {-1, 0}, 0.0);
      },
      [&](World& w) {
        w.addJoint(rodBetween(4, 9, {6, 0.5}, {14, 0.5}));
        w.applyImpulse(kFirst, {0, 0.5}, {-900, 0});
      },
  };
  for (const Mode mode : kSleeping) {
    for (std::size_t i = 0; i < changes.size(); ++i) {
      SCOPED_TRACE("change " + std::to_string(i));
      Pair pair(joinedAsleep(), mode);
      pair.run(300);
      ASSERT_EQ(pair.one.stats().asleep, 12) << "all but the lamp";
      pair.change(changes[i]);
      pair.run(300);
      EXPECT_TRUE(pair.one.save() == pair.watched.save());
    }
  }
}

/// A box that is kicked closes a gap of 1 cm in that step, and meets a box that is parked.
TEST(Parking, AKickWakesTheNeighbourBehindAGap) {
  Scene scene = manyAsleep();
  add(scene, box(1, 1, {30, 0.5}));
  const BodyId kicked{static_cast<std::uint32_t>(scene.bodies.size() - 1)};
  add(scene, box(1, 1, {31.01, 0.5}));
  Pair pair(scene, Mode::MergeSleep);
  pair.run(300);
  ASSERT_GT(pair.one.stats().asleep, 20);
  pair.change([&](World& w) { w.applyImpulse(kicked, {30, 0.5}, {3000, 0}); });
  pair.run(200);
  EXPECT_GT(pair.one.capture().bodies.back().pose().position.x(), 31.02);
  EXPECT_TRUE(pair.one.save() == pair.watched.save());
}

/// A rod that breaks lets its bodies touch: also where one of them is a cart that stands still,
/// with a parked stack on it.
TEST(Parking, ARodThatBreaksAtACartThatStandsLeavesItsStackAsItWas) {
  Scene scene = joinedAsleep();
  scene.joints[6].break_force = 1000;
  for (const Mode mode : kSleeping) {
    Pair pair(scene, mode);
    pair.run(300);
    pair.change([&](World& w) { w.applyImpulse(BodyId{9}, {14, 0.5}, {-2000, 0}); });
    pair.run(1000);
    EXPECT_TRUE(pair.one.capture().joints[6].broken);
    EXPECT_TRUE(pair.one.save() == pair.watched.save());
  }
}

TEST(Parking, ACartThatGoesPullsWhatARodTiesToIt) {
  for (const Mode mode : kSleeping) {
    Pair pair(joinedAsleep(), mode);
    pair.run(1300);
    EXPECT_NEAR(pair.one.capture().bodies[9].pose().position.x(), 16.0, 0.02) << "it began at 14";
    EXPECT_TRUE(pair.one.save() == pair.watched.save());
  }
}

/// The paper's rule unites all that is welded to one floor: also with stacks that have slept there
/// for seconds.
TEST(Parking, BoxesThatFallBesideSleepersMergeWithThemByWayOfTheFloor) {
  Scene scene = onGround();
  for (int i = 0; i < 3; ++i) addColumn(scene, 3, {2.0 * i, 0});
  for (int i = 0; i < 3; ++i) add(scene, box(1, 1, {-3.0 - 2.0 * i, 20.0 + 30.0 * i}));
  scene.settings.merging.rule = MergingRule::Paper;
  scene.settings.unmerging.rule = UnmergingRule::Paper;
  Pair pair(scene, Mode::MergeSleep);
  pair.run(700);
  const Snapshot end = pair.one.capture();
  EXPECT_LT(end.collections.size(), 6u) << "as many as there are without the floor";
  EXPECT_EQ(end.stats.asleep, 12);
}

/// A line of a trace.
std::string traced(const World& world) {
  std::ostringstream out;
  TraceWriter writer(out, world.scene(), world.mode(), world.bodies(), {.timings = false});
  writer.add(world.capture());
  return out.str();
}

TEST(Parking, ALookAtASleeperShowsAllOfItAndChangesNothing) {
  for (const Mode mode : kSleeping) {
    Pair pair(manyAsleep(), mode);
    for (int i = 0; i < 400; ++i) {
      pair.step();
      ASSERT_EQ(traced(pair.one), traced(pair.watched)) << "step " << i;
    }
    ASSERT_GT(pair.one.stats().asleep, 20);
    EXPECT_TRUE(pair.one.save() == pair.watched.save());
  }
}

TEST(Parking, AFrameThatMovesAgainTakesWhatStandsOnIt) {
  for (const Mode mode : kSleeping) {
    Pair pair(manyAsleep(), mode);
    pair.run(1500);
  }
}

TEST(Parking, ADiscThatRollsAlongMeetsOneStackAfterTheOther) {
  for (const Mode mode : kSleeping) {
    Scene scene = manyAsleep();
    BodyDesc ball = disc(0.4, {-1.2, 9});
    ball.velocity = {2, 0};
    ball.restitution = 0.7;
    EmitterDesc throws{.body = named("ball", ball)};
    throws.start = 3.0;
    throws.every = 1.5;
    throws.count = 3;
    scene.emitters.push_back(throws);
    Pair pair(scene, mode);
    pair.run(1200);
    EXPECT_TRUE(pair.one.save() == pair.watched.save());
  }
}

TEST(Parking, APinnedBodyThatIsLetGoTakesAlongWhatLeansOnIt) {
  Scene scene = manyAsleep();
  BodyDesc shelf = box(4, 0.5, {-26, 4});
  shelf.pinned_until = 6.0;
  add(scene, named("shelf", shelf));
  addColumn(scene, 2, {-26, 4.25});
  for (const Mode mode : kSleeping) {
    Pair pair(scene, mode);
    pair.run(900);
  }
}

TEST(Parking, ASavedWorldGoesOnAsIfNothingHadBeenDormant) {
  World one(manyAsleep(), {.mode = Mode::MergeSleep});
  runSteps(one, 300);
  World other(manyAsleep(), {.mode = Mode::MergeSleep});
  other.restore(one.save(), "memory");
  for (int i = 0; i < 200; ++i) {
    if (i == 50) {
      for (World* w : {&one, &other}) w->applyImpulse(BodyId{3}, {0, 2.5}, {2, 0});
    }
    one.step();
    other.step();
    ASSERT_TRUE(seen(one) == seen(other)) << "step " << one.steps();
  }
}

}  // namespace
}  // namespace merge2d
