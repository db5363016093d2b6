#include "tests/scenes/scene_testing.h"

namespace merge2d {
namespace {

TEST(Pile, MergesAndFallsAsleep) {
  SceneRun run("pile");
  run.until(5.0);
  EXPECT_GT(run.count(EventType::Merge), 20);
  run.until(20.0);
  EXPECT_EQ(run.now().stats.bodies, 180);
  EXPECT_EQ(run.now().stats.asleep, 180);
}

class LongPile : public testing::TestWithParam<int> {};

TEST_P(LongPile, FallsAsleepWithAnySeed) {
  SceneRun run("pile", Mode::MergeSleep, {{"seed", std::to_string(GetParam())}});
  run.until(30.0);
  EXPECT_GE(run.now().stats.asleep, 178);
  for (const BodyState& body : run.now().bodies) EXPECT_GT(body.x.y(), -1.0) << index(body.id);
}
INSTANTIATE_TEST_SUITE_P(Long, LongPile, testing::Values(2, 3, 4, 5));

/// Nothing left the tray, and nothing sank into it.
void expectInTheTray(const SceneRun& run) {
  for (const BodyState& body : run.now().bodies) {
    EXPECT_TRUE(body.x.allFinite()) << run.nameOf(body.id);
    EXPECT_GT(body.x.y(), 0.0 - (run.dynamic(body.id) ? 0.0 : 1.0)) << run.nameOf(body.id);
    EXPECT_LT(std::abs(body.x.x()), 20.0) << run.nameOf(body.id);
  }
}

TEST(Funnel, HeapsMergeWhileMoreIsFalling) {
  SceneRun run("funnel");
  run.until(25.0);
  const Stats& stats = run.now().stats;
  EXPECT_GT(stats.bodies, 70);
  EXPECT_LT(stats.active_bodies, stats.bodies / 2);
  expectInTheTray(run);
}

TEST(LongFunnel, RunsForFortyFiveThousandSteps) {
  SceneRun run("funnel");
  run.until(225.0);
  const std::size_t memory = run.world().memoryBytes();
  run.until(450.0);
  const Stats& stats = run.now().stats;
  EXPECT_EQ(run.world().steps(), 45'000);
  EXPECT_GT(stats.bodies, 1390);
  EXPECT_LT(stats.active_bodies, stats.bodies / 3) << "the paper's share";
  EXPECT_LT(run.world().memoryBytes(), 4 * memory);
  expectInTheTray(run);
}

}  // namespace
}  // namespace merge2d
