#include <set>

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
  std::size_t all = 0;
  for (const char* seed : {"1", "3"}) {
    SceneRun run("pile", Mode::MergeSleep, {{"seed", seed}});
    run.until(20.0);
    std::map<std::pair<std::string, std::string>, int> parted;
    for (const SceneRun::Logged& e : run.log()) {
      if (e.type == EventType::Unmerge) ++parted[{e.a, e.b}];
    }
    all += parted.size();
    for (const auto& [pair, times] : parted) {
      EXPECT_LE(times, 12) << pair.first << " and " << pair.second << ", seed " << seed;
    }
  }
  EXPECT_GT(all, 200u) << "of two runs";
}

class LongPile : public testing::TestWithParam<int> {};

TEST_P(LongPile, FallsAsleepInHalfAMinute) {
  SceneRun run("pile", Mode::MergeSleep, {{"seed", std::to_string(GetParam())}});
  run.until(30.0);
  EXPECT_GE(run.now().stats.asleep, 178);
  for (const BodyState& body : run.now().bodies) EXPECT_GT(body.x.y(), -1.0) << index(body.id);
}
INSTANTIATE_TEST_SUITE_P(Long, LongPile, testing::Values(2, 3, 4, 5));

/// Rigid rows see a slow slip in this heap where soft contacts hold, whenever it has merged.
TEST(LongPileAtRest, DoesNotMergeAndPartForEver) {
  SceneRun run("pile", Mode::MergeSleep, {{"seed", "16"}});
  run.until(60.0);
  EXPECT_EQ(run.eventsAfter(4800), 0);
}

/// Nothing left the tray, and nothing sank into it.
void expectInTheTray(const SceneRun& run) {
  constexpr double kWall = 28.0;  // the inner faces of the tray [m]
  for (const BodyState& body : run.now().bodies) {
    EXPECT_TRUE(body.x.allFinite()) << run.nameOf(body.id);
    EXPECT_GT(body.x.y(), 0.0 - (run.dynamic(body.id) ? 0.0 : 1.0)) << run.nameOf(body.id);
    EXPECT_LT(std::abs(body.x.x()), kWall) << run.nameOf(body.id);
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

/// What the funnel and the boxes did over a part of a run.
struct FunnelWatch {
  double fastest = 0.0;                 ///< [m/s]
  double lowest = 1e9, highest = -1e9;  ///< of its centre [m]
  double under_it = 0.0;                ///< top of what lies below the throat [m]
  double overlap = 0.0;                 ///< the deepest [m]
  double room = 1e9;                    ///< to what is nearest, for a box that is born [m]
  int anchored = 0;                     ///< steps in which it is welded to the ground
  std::set<BodyId> boxes = {};          ///< that are there
};

/// How far the boxes that are new this step are from all others, centre to centre.
double roomOfTheNew(const SceneRun& run, std::set<BodyId>& known) {
  double room = 1e9;
  for (const BodyState& born : run.now().bodies) {
    if (!known.insert(born.id).second) continue;
    for (const BodyState& other : run.now().bodies) {
      if (other.id == born.id || !run.nameOf(other.id).ends_with("]")) continue;
      room = std::min(room, (other.x - born.x).norm());
    }
  }
  return room;
}

FunnelWatch watchFunnel(SceneRun& run, double until) {
  FunnelWatch seen;
  for (const BodyState& body : run.now().bodies) seen.boxes.insert(body.id);
  while (run.world().time() < until - 1e-9) {
    run.steps(1);
    const Snapshot& now = run.now();
    const BodyState& funnel = run.body("funnel");
    seen.fastest = std::max(seen.fastest, funnel.v.norm());
    seen.lowest = std::min(seen.lowest, funnel.x.y());
    seen.highest = std::max(seen.highest, funnel.x.y());
    seen.overlap = std::max(seen.overlap, now.stats.max_penetration);
    seen.anchored += run.anchored("funnel");
    if (now.bodies.size() == seen.boxes.size()) continue;
    seen.room = std::min(seen.room, roomOfTheNew(run, seen.boxes));
    for (const BodyState& body : now.bodies) {
      const bool below = std::abs(body.x.x()) < 3.0 && body.x.y() < 8.4 && body.v.norm() < 0.5;
      if (below && run.dynamic(body.id)) seen.under_it = std::max(seen.under_it, body.x.y() + 0.35);
    }
  }
  return seen;
}

/// It hangs on its springs, above the heap, and sways; no box is born in another.
void expectFreeFunnel(const FunnelWatch& seen) {
  EXPECT_GT(seen.fastest, 0.5) << "with the gantry alone it would be 0.15";
  EXPECT_EQ(seen.anchored, 0);
  EXPECT_GT(seen.lowest, 11.5);
  EXPECT_LT(seen.highest, 11.75);
  EXPECT_LT(seen.under_it, 6.5) << "the throat ends at 8.5";
  EXPECT_LT(seen.overlap, 0.1);
  EXPECT_GT(seen.room, 1.2) << "the diagonal of a box is 0.71";
}

TEST(Funnel, SwaysAboveTheHeaps) {
  SceneRun run("funnel");
  expectFreeFunnel(watchFunnel(run, 100.0));
  expectFreeFunnel(watchFunnel(run, 110.0));
  expectInTheTray(run);
}

/// The longest run, in parts of 25 s.
TEST(LongFunnel, HangsFreeAllTheTime) {
  SceneRun run("funnel");
  while (run.world().time() < 450.0 - 1e-9) {
    SCOPED_TRACE(run.world().time());
    expectFreeFunnel(watchFunnel(run, run.world().time() + 25.0));
  }
  int held = 0;
  for (const BodyState& body : run.now().bodies) {
    held += body.collection == run.body("funnel").collection;
  }
  EXPECT_GT(held, 250) << "and so are most of the boxes in it";
  expectInTheTray(run);
}

class LongFunnelIn : public testing::TestWithParam<Mode> {};

TEST_P(LongFunnelIn, RunsForFortyFiveThousandSteps) {
  SceneRun run("funnel", GetParam());
  run.until(225.0);
  const std::size_t memory = run.world().memoryBytes();
  const double per_body = static_cast<double>(memory) / run.now().stats.bodies;
  run.until(450.0);
  const Stats& stats = run.now().stats;
  EXPECT_EQ(run.world().steps(), 45'000);
  EXPECT_GT(stats.bodies, 1390);
  EXPECT_LT(stats.active_bodies, stats.bodies / 3) << "the paper's share";
  EXPECT_LT(run.world().memoryBytes(), 4 * memory);
  EXPECT_LT(static_cast<double>(run.world().memoryBytes()), per_body * stats.bodies);
  expectInTheTray(run);
}
INSTANTIATE_TEST_SUITE_P(Long, LongFunnelIn, testing::Values(Mode::Merge, Mode::MergeSleep));

}  // namespace
}  // namespace merge2d
