/// Guards for what docs/decisions/cures.md tells and no scene elsewhere would notice.

#include <gtest/gtest.h>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

const std::string kBox = kGround + R"(
[[body]]
name = "box"
at = [0, 0.5]
box = [1, 1]
)";

/// Why the box on the ground came free, if it did within the given steps.
EventReason reasonOfUnmerge(Simulation& run, int steps) {
  EventReason reason = EventReason::None;
  run.steps(steps, [&] {
    for (const Event& e : run.world().events()) {
      if (e.type == EventType::Unmerge) reason = e.reason;
    }
  });
  return reason;
}

// A push at the top, a little more than half the weight: the box tips over its right corner.
const std::string kTipping = kBox + R"(
[[force]]
body = "box"
at = [0, 0.5]
force = [5.2, 0]
from = 2
)";

TEST(Cures, ABoxThatTipsOverOneContactIsCutForItsMotion) {
  Simulation run(kTipping, Mode::Merge);
  run.until(2.0);
  ASSERT_TRUE(run.merged("box"));
  EXPECT_EQ(reasonOfUnmerge(run, 30), EventReason::RelativeMotion);
  run.until(4.0);
  EXPECT_LT(run.body("box").angle, -0.1) << "it tips";
}

// Lifted on its left by more than half its weight.
const std::string kLifted = kBox + R"(
[[force]]
body = "box"
at = [-0.5, 0]
force = [0, 6]
from = 2
)";

TEST(Cures, UnderThePapersRuleTheFirstLostContactBreaksTheWeld) {
  Simulation run(kLifted, Mode::Merge, {{"unmerging.rule", "\"paper\""}});
  run.until(2.0);
  ASSERT_TRUE(run.merged("box"));
  EXPECT_EQ(reasonOfUnmerge(run, 30), EventReason::Broken);
}

// The box touches a post and is then knocked against it.
const std::string kAtPost = kBox + R"(
friction = 0.1
[[body]]
name = "post"
motion = "pinned"
at = [1, 0.5]
box = [1, 1]
)";

TEST(Cures, AContactThatCarriedNothingWhenItsPairMergedTakesALoadLater) {
  Simulation run(kAtPost, Mode::Merge);
  run.until(2.0);
  ASSERT_TRUE(run.merged("box"));
  const double before = run.body("box").x.x();
  run.kick("box", {2.0, 0.0});
  EXPECT_EQ(reasonOfUnmerge(run, 50), EventReason::None);
  EXPECT_EQ(run.body("box").x.x(), before);
}

TEST(Cures, UnderThePapersRuleAContactThatCarriedNothingIsForgotten) {
  Simulation run(kAtPost, Mode::Merge, {{"unmerging.rule", "\"paper\""}});
  run.until(2.0);
  ASSERT_TRUE(run.merged("box"));
  const int before = run.count(EventType::Unmerge);
  run.kick("box", {2.0, 0.0});
  EXPECT_NE(reasonOfUnmerge(run, 50), EventReason::None);
  EXPECT_EQ(run.count(EventType::Unmerge) - before, 2);
}

/// The largest force [N] that is missing for a body to stay where it is.
double largestImbalance(const World& world, const Snapshot& now) {
  std::vector<Vec2> force(world.bodies().size(), Vec2::Zero());
  for (const ContactView& c : now.contacts) {
    const Vec2 impulse = c.lambda_n * c.normal + c.lambda_t * perpendicular(c.normal);
    force[index(c.a)] -= impulse / world.scene().step;
    force[index(c.b)] += impulse / world.scene().step;
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    const BodyInfo& body = world.bodies()[i];
    if (body.motion != Motion::Dynamic) continue;
    largest = std::max(largest, (force[i] - Vec2(0.0, body.mass * kGravity)).norm());
  }
  return largest;
}

TEST(Cures, ACollectionSleepsWhenTheForcesInsideCarryItsWeight) {
  Simulation run(wall(5, 40), Mode::MergeSleep);
  const int bodies = run.world().stats().bodies;
  while (run.world().stats().asleep < bodies && run.world().time() < 10.0) run.steps(1);
  ASSERT_EQ(run.world().stats().asleep, bodies);
  EXPECT_LT(largestImbalance(run.world(), run.now()), 0.1 * kGravity);  // boxes weigh 1 kg
}

TEST(Cures, UnderThePapersRuleACollectionSleepsWhateverTheForcesInside) {
  Simulation run(wall(5, 40), Mode::MergeSleep);
  Scene literal = wall(5, 40);
  literal.settings.merging.rule = MergingRule::Paper;
  literal.settings.unmerging.rule = UnmergingRule::Paper;
  Simulation paper(literal, Mode::MergeSleep);
  const auto timeToSleep = [](Simulation& s) {
    while (s.world().stats().asleep < s.world().stats().bodies && s.world().time() < 10.0) {
      s.steps(1);
    }
    return s.world().time();
  };
  const double time = timeToSleep(run), literal_time = timeToSleep(paper);
  EXPECT_LT(literal_time, time);
  EXPECT_NEAR(literal_time, 0.19, 0.03);
  EXPECT_NEAR(time, 0.54, 0.1);
  EXPECT_NEAR(largestImbalance(paper.world(), paper.now()), 0.16 * kGravity, 0.02 * kGravity);
  EXPECT_LT(largestImbalance(run.world(), run.now()), 1e-4 * kGravity);
}

}  // namespace
}  // namespace merge2d
