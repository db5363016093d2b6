#include "tests/scenes/scene_testing.h"

namespace merge2d {
namespace {

TEST(Dominoes, OnlyTheMovingOnesAreFree) {
  SceneRun run("dominoes");
  run.until(0.9);
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(run.anchored(cell("domino", i, 0))) << i;
  run.until(4.0);
  int free = 0;
  for (int i = 0; i < 50; ++i) free += !run.merged(cell("domino", i, 0));
  EXPECT_GE(free, 3);
  EXPECT_LE(free, 30);
  EXPECT_FALSE(run.merged("domino[15,0]")) << "it is falling";
  EXPECT_TRUE(run.merged("domino[49,0]")) << "it still stands";
  run.until(12.0);
  EXPECT_EQ(run.now().stats.asleep, 50);
  EXPECT_EQ(run.eventsAfter(1000), 0);
}

TEST(Dominoes, FallOneAfterTheOther) {
  SceneRun run("dominoes");
  run.until(10.0);
  std::int64_t before = 100;
  for (int i = 0; i < 50; ++i) {
    const std::int64_t step = run.first(EventType::Unmerge, cell("domino", i, 0));
    EXPECT_GT(step, before - 5) << i;
    before = step;
  }
  EXPECT_NEAR(static_cast<double>(before), 830, 25);
}

/// The steps in which one after the other has turned by 45 degrees.
std::vector<std::int64_t> stepsOfFalls(Mode mode, const Overrides& overrides = {}) {
  SceneRun run("dominoes", mode, overrides);
  std::vector<std::int64_t> out;
  while (run.world().time() < 12.0 - 1e-9) {
    run.steps(1);
    const auto fallen = std::ranges::count_if(
        run.now().bodies, [](const BodyState& b) { return std::abs(b.angle) > 0.7854; });
    while (static_cast<std::int64_t>(out.size()) < fallen) out.push_back(run.world().steps());
  }
  return out;
}

TEST(Dominoes, TheKthFallsWithinTwoHundredthsOfASecondOfTheReference) {
  const std::vector<std::int64_t> reference =
      stepsOfFalls(Mode::Reference, {{"solver.iterations", "100"}});
  ASSERT_EQ(reference.size(), 50u);
  for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
    const std::vector<std::int64_t> merged = stepsOfFalls(mode);
    ASSERT_EQ(merged.size(), 50u);
    for (std::size_t k = 0; k < 50; ++k) {
      EXPECT_LE(std::abs(merged[k] - reference[k]), 2) << k << " in " << name(mode);
    }
  }
}

TEST(DominoesPlatforms, TheLastOfEachRowStartsTheNext) {
  SceneRun run("dominoes-platforms");
  run.until(0.9);
  for (const char* row : {"first", "second", "third"}) {
    for (int i = 0; i < 34; ++i) EXPECT_TRUE(run.anchored(cell(row, i, 0))) << row << i;
  }
  EXPECT_EQ(run.now().stats.asleep, 0) << "they all swing";
  run.until(4.0);
  EXPECT_EQ(run.first(EventType::Unmerge, "second[0,0]"), -1);
  run.until(8.0);
  EXPECT_NEAR(static_cast<double>(run.first(EventType::Unmerge, "second[0,0]")), 560, 40);
  EXPECT_EQ(run.first(EventType::Unmerge, "third[0,0]"), -1);
  run.until(20.0);
  EXPECT_NEAR(static_cast<double>(run.first(EventType::Unmerge, "third[0,0]")), 960, 40);
  for (const char* row : {"first", "second", "third"}) {
    EXPECT_TRUE(run.anchored(cell(row, 10, 0))) << "merged with its platform again: " << row;
    EXPECT_TRUE(run.together(cell(row, 10, 0), cell(row, 20, 0))) << row;
  }
  EXPECT_LE(run.now().stats.active_bodies, 6);
}

TEST(DominoesPlatforms, FallAsTheyDoInTheReference) {
  SceneRun reference("dominoes-platforms", Mode::Reference), merged("dominoes-platforms");
  const auto fallen = [](SceneRun& run) {
    return static_cast<int>(std::ranges::count_if(run.now().bodies, [&](const BodyState& b) {
      return run.dynamic(b.id) && std::abs(b.angle) > 0.8;
    }));
  };
  for (const double time : {3.0, 6.0, 9.0, 12.0}) {
    reference.until(time), merged.until(time);
    EXPECT_NEAR(fallen(merged), fallen(reference), 2) << "at " << time << " s";
  }
}

}  // namespace
}  // namespace merge2d
