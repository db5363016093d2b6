#include "tests/scenes/scene_testing.h"

namespace merge2d {
namespace {

/// What Fig. 11 shows: first they merge with each other, then with the ground, then they sleep.
TEST(Pile, MergesWithEachOtherThenWithTheGroundThenFallsAsleep) {
  SceneRun run("pile");
  int most_floating = 0, most_on_ground = 0;
  std::int64_t floating_since = -1, on_ground_since = -1;
  while (run.now().stats.asleep < 90 && run.world().steps() < 2000) {
    run.steps(1);
    int floating = 0, on_ground = 0;
    for (const CollectionView& c : run.now().collections) {
      (c.anchored ? on_ground : floating) += static_cast<int>(c.bodies.size());
    }
    if (floating > 0 && floating_since < 0) floating_since = run.world().steps();
    if (on_ground > 90 && on_ground_since < 0) on_ground_since = run.world().steps();
    most_floating = std::max(most_floating, floating);
    most_on_ground = std::max(most_on_ground, on_ground);
  }
  EXPECT_GT(run.count(EventType::Merge), 100) << "before half of them sleep";
  EXPECT_GT(most_floating, 20);
  EXPECT_GT(most_on_ground, 90) << "half of the bodies";
  EXPECT_GT(floating_since, 0);
  EXPECT_GT(on_ground_since, floating_since);
  run.until(20.0);
  EXPECT_EQ(run.now().stats.bodies, 180);
  EXPECT_EQ(run.now().stats.asleep, 180);
}

TEST(Pile, NoPairMergesAndPartsOverAndOver) {
  SceneRun run("pile");
  run.until(20.0);
  std::map<std::pair<std::string, std::string>, int> parted;
  for (const SceneRun::Logged& e : run.log()) {
    if (e.type == EventType::Unmerge) ++parted[{e.a, e.b}];
  }
  EXPECT_GT(parted.size(), 100u);
  for (const auto& [pair, times] : parted) {
    EXPECT_LE(times, 12) << pair.first << " and " << pair.second;
  }
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
  run.until(20.0);
  int bodies = 0, active = 0;  // summed over ten seconds, as each landing frees what it hits
  for (double t = 20.0; t < 30.0; t += 0.1) {
    run.until(t + 0.1);
    bodies += run.now().stats.bodies;
    active += run.now().stats.active_bodies;
  }
  EXPECT_GT(run.now().stats.bodies, 70);
  EXPECT_LT(active, 0.45 * bodies);
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
