/// Welds that turn about one contact (Section 6.4).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numeric>

#include "src2d/merging/unmerge.h"
#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

const std::string kSeeSaw = kGround + R"(
[[body]]
name = "pivot"
motion = "pinned"
polygon = [[-0.4, 0], [0.4, 0], [0, 0.5]]
[[body]]
name = "beam"
at = [0.02, 0.6]
box = [4, 0.2]
)";

/// In balance, until from 4 s on one end is pushed with a force [N].
std::string pushedSeeSaw(double force) {
  std::string balanced = kSeeSaw;
  balanced.replace(balanced.find("[0.02, 0.6]"), 11, "[0.00, 0.6]");
  return balanced +
         fmt::format("[[force]]\nbody = \"beam\"\nat = [1.9, 0]\nforce = [0, {}]\nfrom = 4\n",
                     force);
}

TEST(Unmerge, ASeeSawOutOfBalanceTips) {
  for (const char* let_go : {"", "pinned_until = 2\n"}) {
    Simulation reference(kSeeSaw + let_go, Mode::Reference);
    Simulation merged(kSeeSaw + let_go, Mode::MergeSleep);
    reference.until(15.0);
    merged.until(15.0);
    EXPECT_LT(reference.body("beam").angle, -0.2);
    EXPECT_NEAR(merged.body("beam").angle, reference.body("beam").angle, 0.02);
    EXPECT_NEAR(merged.body("beam").angle, -14.3 * kDegree, 0.1 * kDegree);
  }
}

TEST(Unmerge, UnderThePapersRuleTheSeeSawIsStuck) {
  Overrides paper = kPaper;
  Simulation run(kSeeSaw, Mode::Merge, paper);
  run.until(15.0);
  EXPECT_TRUE(run.merged("beam"));
  EXPECT_NEAR(run.body("beam").angle, 0.0, 0.01 * kDegree);
}

TEST(Unmerge, UnderThePapersRuleAWeldThatTurnsBreaksAfterTheGivenSteps) {  // Figure 4, Section 6.4
  for (const int steps : {3, 6}) {
    Overrides overrides = kPaper;
    overrides.push_back({"unmerging.steps", std::to_string(steps)});
    Simulation run(pushedSeeSaw(-8.0), Mode::Merge, overrides);
    run.until(4.0);
    ASSERT_TRUE(run.merged("beam"));
    run.steps(steps - 1, [&] { ASSERT_TRUE(run.merged("beam")) << steps; });
    run.steps(1);
    EXPECT_FALSE(run.merged("beam"));
    EXPECT_EQ(events(run, EventType::Unmerge, EventReason::RelativeMotion), 1);
    run.until(6.0);
    EXPECT_LT(run.body("beam").angle, -0.2);
  }
}

TEST(Unmerge, APivotThatGathersSpeedSlowlyBreaksToo) {
  // No step alone would be fast enough.
  const auto parted = [&](Overrides overrides) {
    overrides.push_back({"merging.cycles", "\"off\""});
    Simulation run(pushedSeeSaw(-0.4), Mode::Merge, overrides);
    run.until(4.0);
    EXPECT_TRUE(run.merged("beam"));
    int turned = 0;
    run.steps(100, [&] { turned += events(run, EventType::Unmerge, EventReason::RelativeMotion); });
    return turned;
  };
  EXPECT_GT(parted({}), 0);
  EXPECT_EQ(parted({{"unmerging.rule", "\"paper\""}}), 0);
}

TEST(Unmerge, APlankWhoseSupportIsKnockedAwayFalls) {
  const std::string scene = kGround + R"(
[[body]]
name = "left"
at = [-2, 0.5]
box = [0.4, 1]
[[body]]
name = "right"
at = [2, 0.5]
box = [0.4, 1]
[[body]]
name = "plank"
at = [0, 1.1]
box = [5, 0.2]
friction = 0.05
)";
  const auto end = [&](Mode mode) {
    Simulation run(scene, mode);
    run.until(4.0);
    EXPECT_EQ(run.merged("plank"), merges(mode));
    run.kick("right", {4.0, 0.0}, {0.0, -0.2});
    run.until(7.0);
    return run.body("plank");
  };
  const BodyState reference = end(Mode::Reference), merged = end(Mode::MergeSleep);
  EXPECT_LT(reference.x.y(), 0.9);
  EXPECT_NEAR(merged.x.y(), reference.x.y(), 0.1);
  EXPECT_NEAR(merged.angle, reference.angle, 0.1);
}

TEST(Unmerge, APlankFallsWhenItsMagnetLetsGo) {
  for (const Mode mode : {Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
    SCOPED_TRACE(name(mode));
    Simulation run(R"(
format = 1
[[body]]
name = "crane"
motion = "pinned"
at = [0, 10.5]
box = [2, 1]
[[body]]
name = "plank"
at = [0, 9.9]
box = [1.5, 0.2]
[[magnet]]
body = "crane"
on = [[0, 3]]
)",
                   mode);
    run.until(3.0);
    EXPECT_NEAR(run.body("plank").x.y(), 9.9, 0.02);
    run.until(4.0);
    EXPECT_NEAR(run.body("plank").x.y(), 9.9 - 0.5 * 9.81, 0.1);
  }
}

}  // namespace
}  // namespace merge2d
