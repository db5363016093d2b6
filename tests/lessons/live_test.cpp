#include "lessons/live.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lessons/step_text.h"
#include "tests/lessons/live_testing.h"

namespace merge2d {
namespace {

using nlohmann::json;

Vec2 placeOf(const Live& live, BodyId id) { return live.world().capture().bodies[index(id)].x; }

TEST(Live, AHeldBodyComesToTheHandAndStaysThere) {
  Live live = stack();
  live.skipTo(100);
  live.drag(BodyId{2}, {.grip = {0, 0}, .target = {3, 3}});
  live.skipTo(400);
  const double sag = 9.81 / (12.0 * 12.0);  // weight by stiffness
  EXPECT_NEAR(placeOf(live, BodyId{2}).x(), 3.0, 0.01);
  EXPECT_NEAR(placeOf(live, BodyId{2}).y(), 3.0 - sag, 0.02);
}

TEST(Live, TheForceOfTheHandCarriesTheWeight) {
  Live live = stack();
  live.drag(BodyId{2}, {.grip = {0, 0}, .target = {3, 3}});
  live.skipTo(400);
  EXPECT_NEAR(live.force(BodyId{2}).y(), 9.81, 0.2);  // 1 kg
}

TEST(Live, ABodyLetGoWhileItMovesIsThrown) {
  Live live = stack();
  live.drag(BodyId{2}, {.grip = {0, 0}, .target = {3, 4}});
  live.skipTo(10);
  live.letGo(BodyId{2});
  live.skipTo(11);
  EXPECT_GT(live.world().capture().bodies[2].v.norm(), 1.0);
  EXPECT_TRUE(live.force(BodyId{2}).isZero());
}

TEST(Live, AHandAtAFixedBodyMovesNothing) {
  Live live = stack();
  live.drag(BodyId{0}, {.grip = {0, 0}, .target = {3, 3}});
  live.skipTo(20);
  EXPECT_EQ(placeOf(live, BodyId{0}), Vec2(0, -0.5));
}

TEST(StepText, HoldsTheStateTheDecisionsAndTheImpulsesInside) {
  Live live = stack(Mode::Merge);
  live.skipTo(100);
  const StepRecord record = live.step();
  const json step = json::parse(stepText(record, live.world().bodies()));
  EXPECT_EQ(step["step"], 101);
  ASSERT_EQ(step["bodies"].size(), 3);
  EXPECT_DOUBLE_EQ(step["bodies"][2][2], record.after.bodies[2].x.y());
  EXPECT_EQ(step["bodies"][2][7], value(record.after.bodies[2].collection));
  EXPECT_EQ(step["contacts"].size(), record.after.contacts.size());
  EXPECT_EQ(step["inside"].size(), step["contacts"].size());
  EXPECT_EQ(step["stats"][0], record.after.stats.active_bodies);
  EXPECT_FALSE(step["sweeping"]) << "its load is known to be carried";
}

TEST(StepText, TellsThatTheImpulsesInsideAreSolvedInABlow) {
  Live live = stack(Mode::Merge);
  live.skipTo(100);
  live.world().applyImpulse(BodyId{2}, {0, 2}, {0.5, 0});
  EXPECT_TRUE(json::parse(stepText(live.step(), live.world().bodies()))["sweeping"]);
}

TEST(StepText, UnderThePapersRuleImpulsesInsideAreSweptInEachStep) {
  Scene scene = stackScene();
  scene.settings.unmerging.rule = UnmergingRule::Paper;
  Live live(scene, Mode::Merge);  // sleeping bodies are not swept
  live.skipTo(100);
  EXPECT_TRUE(json::parse(stepText(live.step(), live.world().bodies()))["sweeping"]);
}

TEST(StepText, TellsAMergeAndItsMomentum) {
  Live live = stack();
  for (int i = 0; i < 100; ++i) {
    const json step = json::parse(stepText(live.step(), live.world().bodies()));
    if (step["events"].empty() || step["events"][0][1] != "merge") continue;
    ASSERT_FALSE(step["ledger"].empty());
    EXPECT_EQ(step["ledger"][0][0], step["step"]);
    return;
  }
  FAIL() << "nothing merged";
}

}  // namespace
}  // namespace merge2d
