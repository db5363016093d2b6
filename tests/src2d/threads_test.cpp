/// The bytes of a run do not depend on the number of threads that share its work.

#include <gtest/gtest.h>

#include <string>

#include "src2d/world.h"
#include "tests/src2d/world_edit_testing.h"

namespace merge2d {
namespace {

constexpr Mode kModesOfThreads[] = {Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep};

/// Enough of everything for several tasks in every stage: pyramids, bouncing balls, jointed chains,
/// compound bodies, and a scripted cart.
Scene crowd() {
  Scene scene = onGround();
  for (int i = 0; i < 8; ++i) {
    for (int row = 0; row < 5; ++row) {
      for (int k = 0; k < 5 - row; ++k) {
        add(scene, box(1, 1, {7.0 * i - 40 + k + 0.5 * row, row + 0.5}));
      }
    }
    BodyDesc ball = disc(0.4, {7.0 * i - 38, 9.0 + 0.3 * i});
    ball.restitution = 0.6;
    add(scene, ball);
    BodyDesc tee = box(0.2, 1, {7.0 * i - 35.5, 1.0});
    tee.shapes.emplace_back(makeBox(1, 0.2, Pose::at({0, 0.6}, 0)));
    add(scene, tee);
  }
  for (int i = 0; i < 4; ++i) {
    add(scene, box(1.8, 0.2, {20.0 + 2.0 * i, 6}));
    const BodyIndex here = scene.bodies.size() - 1;
    const std::optional<BodyIndex> before = i > 0 ? std::optional(here - 1) : std::nullopt;
    scene.joints.push_back(jointOf(JointKind::Revolute, here, before, {19.0 + 2.0 * i, 6}));
  }
  SteadyMotion way;
  way.velocity = {1.5, 0};
  add(scene, named("cart", scripted(box(2, 1, {-50, 0.5}), way)));
  return scene;
}

std::string endOf(const Scene& scene, Mode mode, int threads, bool decisions = false) {
  World world(scene, {.mode = mode, .timings = false, .decisions = decisions, .threads = threads});
  runSteps(world, 100);
  world.applyImpulse(BodyId{3}, {-38, 0.5}, {3, 1});
  runSteps(world, 200);
  return world.save();
}

TEST(Threads, TheResultIsTheSameWithAnyNumberOfThem) {
  for (const Mode mode : kModesOfThreads) {
    const std::string alone = endOf(crowd(), mode, 1);
    for (const int threads : {2, 3, 8}) {
      EXPECT_TRUE(endOf(crowd(), mode, threads) == alone) << name(mode) << " " << threads;
    }
  }
}

TEST(Threads, EverySolverGivesTheSame) {
  for (const SolverMethod method : {SolverMethod::Pgs, SolverMethod::Nncg, SolverMethod::Newton}) {
    Scene scene = crowd();
    scene.settings.solver.method = method;
    EXPECT_TRUE(endOf(scene, Mode::Merge, 3) == endOf(scene, Mode::Merge, 1));
  }
  Scene scene = crowd();
  scene.settings.solver.stabilisation = Stabilisation::Post;
  EXPECT_TRUE(endOf(scene, Mode::Merge, 3) == endOf(scene, Mode::Merge, 1));
}

/// More than a thousand contacts hang together: their sweeps are shared, and so are those inside
/// the collection that they become.
TEST(Threads, ALargeHeapIsSolvedTheSame) {
  const auto end = [](Mode mode, int threads) {
    World world(wall(30, 25), {.mode = mode, .timings = false, .threads = threads});
    runSteps(world, 20);
    world.applyImpulse(BodyId{400}, {0, 10}, {5, 2});
    runSteps(world, 20);
    return world.save();
  };
  for (const Mode mode : {Mode::Reference, Mode::Merge}) {
    const std::string alone = end(mode, 1);
    for (const int threads : {2, 3}) EXPECT_TRUE(end(mode, threads) == alone) << name(mode);
  }
}

/// A wide wall under discs. Some bricks bounce, some discs bounce or resist rolling: their rows are
/// made one by one, and in many colours two groups of a kind are not full.
TEST(Threads, LargeColoursOfAllKindsOfRowsAreSolvedTheSame) {
  Scene scene = wall(4, 150);
  for (std::size_t i = 1; i < scene.bodies.size(); i += 7) scene.bodies[i].restitution = 0.2;
  for (int i = 0; i < 149; ++i) {
    BodyDesc ball = disc(0.1, {i - 74.0, 4.1});
    if (i % 3 == 0) ball.restitution = 0.5;
    if (i % 5 == 0) ball.rolling = 0.01;
    add(scene, ball);
  }
  const auto end = [&](int threads) {
    World world(scene, {.mode = Mode::Reference, .timings = false, .threads = threads});
    runSteps(world, 40);
    EXPECT_GT(world.stats().contacts, 2000);
    return world.save();
  };
  const std::string alone = end(1);
  for (const int threads : {2, 3}) EXPECT_TRUE(end(threads) == alone);
}

/// Stacks side by side on one moving floor, each a collection whose load is new in each step.
TEST(Threads, ManySearchesAtOnceFindTheSame) {
  const auto end = [](int threads) {
    const Sinusoid swing{.axis = Vec2::UnitX(), .amplitude = 0.05, .period = 2.0};
    Scene scene;
    add(scene, named("floor", scripted(box(50, 1, {0, -0.5}), swing)));
    for (int i = 0; i < 30; ++i) addColumn(scene, 3 + i % 3, {1.3 * i - 19, 0});
    World world(scene, {.mode = Mode::Merge, .timings = false, .threads = threads});
    runSteps(world, 200);
    EXPECT_GT(world.stats().collections, 20);
    return world.save();
  };
  const std::string alone = end(1);
  for (const int threads : {2, 8}) EXPECT_TRUE(end(threads) == alone);
}

TEST(Threads, WhoeverAsksGetsTheSameDecisions) {
  const auto decisions = [](int threads) {
    World world(crowd(), {.decisions = true, .threads = threads});
    std::string all;
    for (int i = 0; i < 150; ++i) {
      world.step();
      for (const Decision& d : world.notes().decisions) {
        all += std::to_string(index(d.a)) + " " + std::string(d.criterion) + " " +
               std::to_string(d.value) + "\n";
      }
    }
    return all;
  };
  EXPECT_EQ(decisions(3), decisions(1));
}

TEST(Threads, ARestoredWorldKeepsItsThreads) {
  World world(crowd(), {.threads = 2});
  runSteps(world, 50);
  const std::string middle = world.save();
  runSteps(world, 50);
  const std::string end = world.save();
  world.restore(middle, "memory");
  runSteps(world, 50);
  EXPECT_TRUE(world.save() == end);
}

}  // namespace
}  // namespace merge2d
