/// What a world tells about itself.

#include "src2d/world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src2d/core/error.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

using testing::ElementsAre;

TEST(World, BeforeTheFirstStepItIsTheScene) {
  const Scene scene = sceneOf(R"(
    [[body]]
    name = "floor"
    motion = "pinned"
    box = [4, 1]
    [[body]]
    name = "box"
    at = [1, 5]
    angle = 30
    velocity = [1, 2]
    spin = 180
    box = [2, 1]
    density = 3
  )");
  const World world = reference(scene);
  EXPECT_EQ(world.steps(), 0);
  EXPECT_EQ(world.time(), 0.0);
  EXPECT_EQ(world.mode(), Mode::Reference);
  ASSERT_EQ(world.bodies().size(), 2u);
  EXPECT_EQ(world.bodies()[1].name, "box");
  EXPECT_DOUBLE_EQ(world.bodies()[1].mass, 6.0);
  EXPECT_DOUBLE_EQ(world.bodies()[1].inertia, 6.0 * (4.0 + 1.0) / 12.0);
  const BodyState body = see(world, "box");
  EXPECT_EQ(body.x, Vec2(1, 5));
  EXPECT_EQ(body.v, Vec2(1, 2));
  EXPECT_DOUBLE_EQ(body.angle, 30 * kDegree);
  EXPECT_DOUBLE_EQ(body.omega, 180 * kDegree);
  EXPECT_EQ(body.collection, kNoCollection);
  EXPECT_TRUE(see(world, "floor").pinned);
  EXPECT_EQ(world.stats().bodies, 1);
}

TEST(World, TimeIsTheNumberOfStepsTimesTheStep) {
  Scene scene = onGround();
  scene.step = 0.1;
  World world = reference(scene);
  runSteps(world, 30);
  EXPECT_EQ(world.steps(), 30);
  EXPECT_EQ(world.time(), 30 * 0.1);
}

TEST(World, MassOverridesDensityAndInertiaFollows) {
  Scene scene;
  BodyDesc body = disc(2.0, {0, 0});
  body.mass = 5.0;
  body.density = 100.0;
  add(scene, body);
  const World world = reference(scene);
  EXPECT_DOUBLE_EQ(world.bodies()[0].mass, 5.0);
  EXPECT_DOUBLE_EQ(world.bodies()[0].inertia, 0.5 * 5.0 * 4.0);
}

TEST(World, EnergyAndMomentumAreThoseOfTheBodiesThatMove) {
  Scene scene = onGround();
  BodyDesc body = box(2, 1, {3, 4});
  body.velocity = {2, 1};
  body.spin = 3.0;
  add(scene, body);
  const Stats stats = reference(scene).capture().stats;
  const double mass = 2.0, inertia = 2.0 * 5.0 / 12.0;
  EXPECT_DOUBLE_EQ(stats.kinetic_energy, 0.5 * mass * 5.0 + 0.5 * inertia * 9.0);
  EXPECT_DOUBLE_EQ(stats.potential_energy, mass * kGravity * 4.0);
  EXPECT_EQ(stats.momentum, Vec2(4, 2));
  EXPECT_DOUBLE_EQ(stats.angular_momentum, inertia * 3.0 + mass * (3 * 1 - 4 * 2));
}

TEST(World, CountsAgreeWithWhatIsSeen) {
  for (const Mode mode : {Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
    World world(wall(5, 5), inMode(mode));
    for (int i = 0; i < 200; ++i) {
      world.step();
      const Snapshot seen = world.capture();
      int dynamic = 0, asleep = 0, free_and_awake = 0;
      for (const BodyState& body : seen.bodies) {
        if (world.bodies()[index(body.id)].motion != Motion::Dynamic) continue;
        ++dynamic;
        asleep += body.asleep;
        free_and_awake += !body.asleep && body.collection == kNoCollection;
      }
      int internal = 0, awake_collections = 0;
      for (const ContactView& c : seen.contacts) internal += c.internal;
      for (const CollectionView& c : seen.collections) awake_collections += !c.asleep;
      ASSERT_EQ(world.stats().bodies, dynamic);
      ASSERT_EQ(world.stats().asleep, asleep);
      ASSERT_EQ(world.stats().active_bodies, free_and_awake + awake_collections);
      ASSERT_EQ(static_cast<std::size_t>(world.stats().collections), seen.collections.size());
      if (asleep > 0) continue;  // what sleeps is not swept
      ASSERT_EQ(world.stats().internal_contacts, internal);
    }
  }
}

class StageList : public Observer {
 public:
  void afterStage(Stage stage, const State&, const Scratch&) override {
    stages.emplace_back(name(stage));
  }
  std::vector<std::string> stages;
};

TEST(World, AStepHasTheElevenStagesOfAlgorithm1InTheirOrder) {
  World world(wall(3, 3));
  StageList list;
  world.observe(&list);
  world.step();
  EXPECT_THAT(list.stages,
              ElementsAre("ContactDetection", "ContactOrdering", "SleepAndWake", "WarmStart",
                          "SingleIterationPGS", "Unmerge", "SolveLCP", "AdvanceVelocities",
                          "AccumulateRelativeMotion", "AdvancePositions", "Merge"));
  world.observe(nullptr);
  world.step();
  EXPECT_EQ(list.stages.size(), kStages);
}

TEST(World, TimingsAreMeasuredOnlyWhenAskedFor) {
  World timed(wall(5, 5), {.mode = Mode::Reference, .timings = true});
  World untimed = reference(wall(5, 5));
  timed.step();
  untimed.step();
  EXPECT_GT(timed.stats().seconds[static_cast<std::size_t>(Stage::SolveLCP)], 0.0);
  for (const double seconds : untimed.stats().seconds) EXPECT_EQ(seconds, 0.0);
}

TEST(World, DecisionsAreRecordedOnlyWhenAskedFor) {
  World asked(column(3), {.mode = Mode::Merge, .timings = false, .decisions = true});
  World silent(column(3), inMode(Mode::Merge));
  asked.step();
  silent.step();
  EXPECT_FALSE(asked.capture().decisions.empty());
  EXPECT_TRUE(silent.capture().decisions.empty());
}

TEST(World, AContactsForcesActEquallyOnBothBodies) {
  World world = reference(column(2));
  const double h = world.scene().step;
  Vec2 before = world.capture().stats.momentum;
  for (int i = 0; i < 50; ++i) {
    world.step();
    const Snapshot seen = world.capture();
    Vec2 from_ground = 2.0 * h * world.scene().gravity;
    for (const ContactView& c : seen.contacts) {
      if (c.a != BodyId{0}) continue;
      from_ground += c.lambda_n * c.normal + c.lambda_t * perpendicular(c.normal);
    }
    ASSERT_LT((seen.stats.momentum - before - from_ground).norm(), 1e-12);
    before = seen.stats.momentum;
  }
}

TEST(World, AMergedWallHoldsAKilobyteAndAHalfPerBodyAFreeOneTwice) {
  for (const auto& [width, height] : {std::pair(9, 11), std::pair(31, 32)}) {
    for (const Mode mode : {Mode::Reference, Mode::MergeSleep}) {
      const Scene scene = wall(width, height);
      World world(scene, inMode(mode));
      runSteps(world, 150);
      const std::size_t most = merges(mode) ? 1500 : 2800;
      EXPECT_LT(world.memoryBytes() / scene.bodies.size(), most) << name(mode) << " " << width;
    }
  }
}

/// While it swings it has found as many proofs as it keeps, each with all impulses inside.
TEST(World, ASwingingWallHoldsLessThanTwoKilobytesPerBody) {
  const Scene scene = wallOnSwingingPlatform(31, 32, 0.4, 1.0);
  World world(scene, inMode(Mode::Merge));
  runSteps(world, 1500);
  ASSERT_EQ(world.stats().collections, 1);
  EXPECT_LT(world.memoryBytes() / scene.bodies.size(), 1900u);
}

/// Boxes that fell together any way round: each is near many others, most of which it does not
/// touch.
Scene heap(int columns, int rows) {
  Scene scene = onGround();
  for (const double side : {-1.0, 1.0}) {
    add(scene, pinned(box(1, 60, {side * (0.7 * columns + 0.6), 30})));
  }
  for (int i = 0; i < columns * rows; ++i) {
    const double x = 1.4 * (i % columns) - 0.7 * (columns - 1);
    BodyDesc body = box(1, 0.8, {x + 0.1 * (i % 3), 1.0 + 1.4 * std::floor(i / columns)});
    body.angle = 0.7 * (i % 9);
    add(scene, std::move(body));
  }
  return scene;
}

TEST(World, AHeapHoldsLessThanTwoAndAHalfKilobytesPerBody) {
  for (const Mode mode : {Mode::Reference, Mode::MergeSleep}) {
    const Scene scene = heap(12, 15);
    World world(scene, inMode(mode));
    runSteps(world, 400);
    EXPECT_LT(world.memoryBytes() / scene.bodies.size(), 2500u) << name(mode);
  }
}

/// Buffers are given back at each merge: no step tells for all.
TEST(World, AHeapHoldsAboutTwoKilobytesPerBodyOnAverage) {
  for (const Mode mode : {Mode::Reference, Mode::MergeSleep}) {
    const Scene scene = heap(12, 15);
    World world(scene, inMode(mode));
    runSteps(world, 350);
    std::size_t sum = 0;
    for (int i = 0; i < 50; ++i) {
      world.step();
      sum += world.memoryBytes();
    }
    EXPECT_LT(sum / 50 / scene.bodies.size(), 2200u) << name(mode);
  }
}

/// What sleeps is in no list of the step, but is seen all the same.
TEST(World, TheMotionOfASleepingHeapIsCapturedLikeAllElse) {
  World world(wall(6, 6), inMode(Mode::MergeSleep));
  runSteps(world, 400);
  Snapshot motion;
  world.captureMotion(motion);
  const Snapshot all = world.capture();
  ASSERT_FALSE(all.collections.empty());
  ASSERT_TRUE(all.collections.front().asleep);
  ASSERT_EQ(motion.bodies.size(), all.bodies.size());
  for (std::size_t i = 0; i < all.bodies.size(); ++i) {
    EXPECT_EQ(motion.bodies[i].x, all.bodies[i].x) << i;
    EXPECT_EQ(motion.bodies[i].collection, all.bodies[i].collection) << i;
    EXPECT_EQ(motion.bodies[i].asleep, all.bodies[i].asleep) << i;
  }
  ASSERT_EQ(motion.collections.size(), all.collections.size());
  EXPECT_EQ(motion.collections.front().id, all.collections.front().id);
  EXPECT_EQ(motion.collections.front().bodies, all.collections.front().bodies);
  EXPECT_EQ(motion.stats.asleep, all.stats.asleep);
}

TEST(World, TheDeepestOverlapIsThatOfAllContactsInBothCaptures) {
  for (const Mode mode : {Mode::Reference, Mode::Merge, Mode::MergeSleep}) {
    World world(wall(6, 6), inMode(mode));
    for (const int steps : {0, 1, 20, 400}) {
      runSteps(world, steps);
      Snapshot motion;
      world.captureMotion(motion);
      const Snapshot all = world.capture();
      double deepest = 0.0;
      for (const ContactView& contact : all.contacts) deepest = std::max(deepest, -contact.gap);
      EXPECT_EQ(all.stats.max_penetration, deepest) << name(mode) << " " << steps;
      EXPECT_EQ(motion.stats.max_penetration, deepest) << name(mode) << " " << steps;
      EXPECT_EQ(deepest > 0.0, steps > 1);
    }
  }
}

TEST(World, CountsTheMemoryOfItsWideSweeps) {
  const auto bytesBy = [](SweepPath path) {
    WorldOptions options = inMode(Mode::Reference);
    options.sweep_path = path;
    World world(wall(10, 10), options);
    runSteps(world, 50);
    return world.memoryBytes();
  };
  EXPECT_GT(bytesBy(SweepPath::Portable), bytesBy(SweepPath::OneByOne));
}

TEST(World, AGivenSceneIsSharedNotCopied) {
  const auto scene = std::make_shared<const Scene>(column(2));
  const World world(scene, inMode(Mode::Reference));
  EXPECT_EQ(&world.scene(), scene.get());
}

TEST(World, AWorldCanBeMoved) {
  World world = reference(column(2));
  runSteps(world, 5);
  World other = std::move(world);
  other.step();
  EXPECT_EQ(other.steps(), 6);
}

TEST(World, ASceneThatAProgramHasBuiltIsCheckedAsThatOfAFile) {
  Scene scene = column(2);
  scene.bodies[1].shapes.clear();
  EXPECT_THROW(World{scene}, InputError);
  scene = column(2);
  scene.joints.emplace_back().a = 7;
  EXPECT_THROW(World{scene}, InputError);
  scene = noGravity();
  for (int i = 0; i < 200; ++i) add(scene, box(1, 1, {0, 0}));
  EXPECT_THROW(World{scene}, InputError) << "a crowd in one place";
}

}  // namespace
}  // namespace merge2d
