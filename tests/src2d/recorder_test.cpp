#include "src2d/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <set>

#include "tests/support/fingerprint.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// Where a column of two boxes under Table 1 is welded together.
StepRecord firstMerge(Recorder& recorder) {
  for (int i = 0; i < 300; ++i) {
    StepRecord record = recorder.record();
    if (!record[Stage::Merge].after.events.empty()) return record;
  }
  throw std::runtime_error("nothing merged");
}

TEST(Recorder, RecordedStepsEqualUnwatchedOnesBitForBit) {
  const Scene scene = column(3);
  Recorder recorder(scene);
  World world(scene, {.timings = false});
  for (int i = 0; i < 150; ++i) {
    world.step();
    const Fingerprint expected(world.capture());
    ASSERT_EQ(Fingerprint(recorder.record().after), expected) << "step " << i + 1;
  }
}

TEST(Recorder, WhoAsksForReasonsChangesNothingUnderEitherRule) {
  for (const char* rule : {"default", "paper"}) {
    const Scene scene = loadScene("tower-platform", {{"unmerging.rule", rule}});
    World asked(scene, {.mode = Mode::Merge, .timings = false, .decisions = true});
    World unasked(scene, {.mode = Mode::Merge, .timings = false});
    for (int i = 0; i < 60; ++i) {
      asked.step(), unasked.step();
      ASSERT_EQ(Fingerprint(asked.capture()), Fingerprint(unasked.capture()))
          << rule << ", step " << i + 1;
    }
  }
}

TEST(Recorder, EachStageHasItsOwnEventsAndDecisions) {
  Recorder recorder(column(2));
  std::size_t decisions = 0;
  for (int i = 0; i < 150; ++i) {
    const StepRecord record = recorder.record();
    EXPECT_EQ(record.step, i + 1);
    EXPECT_EQ(record.before.step, i);
    EXPECT_EQ(record.after.step, i + 1);
    std::size_t in_stages = 0, events = 0;
    for (std::size_t s = 0; s < kStages; ++s) {
      for (const Decision& d : record.stages[s].after.decisions) {
        EXPECT_EQ(d.stage, name(static_cast<Stage>(s)));
      }
      in_stages += record.stages[s].after.decisions.size();
      events += record.stages[s].after.events.size();
    }
    EXPECT_EQ(in_stages, record.after.decisions.size());
    EXPECT_EQ(events, record.after.events.size());
    decisions += in_stages;
  }
  EXPECT_GT(decisions, 50u);
}

TEST(Recorder, UnderThePapersRuleTheOrderOfTheSweepLeadsAwayFromTheBlow) {
  Scene scene = column(4);
  scene.settings.unmerging.rule = UnmergingRule::Paper;
  scene.impulses.push_back({.body = 4, .at = {0.0, 4.5}, .impulse = {0.0, -1.0}, .time = 3.0});
  Recorder recorder(scene, Mode::Merge);
  recorder.skipTo(300);
  std::vector<std::array<int, 3>> visits;
  for (const NotedVisit& v : recorder.record().notes.order) {
    visits.push_back({static_cast<int>(v.a), static_cast<int>(v.b), v.depth});
  }
  using Visit = std::array<int, 3>;
  EXPECT_THAT(visits, ElementsAre(Visit{3, 4, 1}, Visit{2, 3, 2}, Visit{1, 2, 3}, Visit{0, 1, 4}));
}

TEST(Recorder, AStageStartsWhereTheOneBeforeItEnded) {
  Recorder recorder(column(2));
  recorder.skipTo(10);
  const StepRecord record = recorder.record();
  EXPECT_EQ(&record.before_stage(Stage::ContactDetection), &record.before);
  EXPECT_EQ(&record.before_stage(Stage::Merge), &record[Stage::AdvancePositions].after);
  // A falling-in body moves in AdvancePositions, and only there.
  const auto height = [](const Snapshot& s) { return s.bodies[1].x.y(); };
  EXPECT_EQ(height(record[Stage::AccumulateRelativeMotion].after), height(record.before));
  EXPECT_EQ(height(record[Stage::AdvancePositions].after), height(record.after));
}

TEST(Recorder, APairCountsUpToTheThresholdAndThenMerges) {
  Recorder recorder(column(1));
  const StepRecord merged = firstMerge(recorder);
  std::vector<std::string_view> criteria, verdicts;
  for (const Decision& d : merged.after.decisions) {
    if (d.a == d.b || d.stage == "ContactOrdering") continue;
    criteria.push_back(d.criterion);
    verdicts.push_back(d.verdict);
    if (d.stage != "AccumulateRelativeMotion") continue;
    EXPECT_EQ(d.before, 2) << d.criterion;
    EXPECT_EQ(d.count, 3) << d.criterion;
    EXPECT_EQ(d.needed, 3) << d.criterion;
    EXPECT_LT(d.value, d.threshold) << d.criterion;
  }
  EXPECT_THAT(criteria, ElementsAre("sliding", "breathing", "edge", "load", "relative-motion",
                                    "count", "cycle"));
  EXPECT_THAT(verdicts, ElementsAre("below", "below", "below", "below", "below", "merge", "merge"));
}

TEST(Recorder, APairThatFailsOneTestLosesItsWholeCount) {
  // Slides on, so that the slip is above and nothing else need be.
  Scene scene = column(1);
  scene.bodies[1].velocity = {3.0, 0.0};
  Recorder recorder(scene);
  recorder.skipTo(20);
  const StepRecord record = recorder.record();
  std::set<std::string_view> apart;
  for (const Decision& d : record[Stage::AccumulateRelativeMotion].after.decisions) {
    if (d.a == d.b) continue;
    EXPECT_EQ(d.count, 0) << d.criterion;
    if (d.verdict == "apart") apart.insert(d.criterion);
  }
  EXPECT_TRUE(apart.contains("sliding"));
  EXPECT_TRUE(apart.contains("relative-motion"));
  EXPECT_THAT(record[Stage::Merge].after.decisions, IsEmpty());
}

TEST(Recorder, CornersMoveAsTheCriterionSays) {
  Scene scene = column(1);
  scene.bodies[1].velocity = {3.0, 0.0};
  Recorder recorder(scene);
  recorder.skipTo(5);
  const StepRecord record = recorder.record();
  double fastest = 0.0, value = -1.0;
  for (const NotedCorners& corners : record.notes.corners) {
    for (const Vec2& v : corners.velocity) fastest = std::max(fastest, v.norm());
  }
  for (const Decision& d : record.after.decisions) {
    if (d.criterion == "relative-motion") value = d.value;
  }
  EXPECT_GT(value, 1.0);
  EXPECT_DOUBLE_EQ(fastest, value);
}

/// Impacts by step.
std::vector<std::int64_t> impactsOf(const Scene& scene, Mode mode, int steps) {
  World world(scene, {.mode = mode, .timings = false});
  std::vector<std::int64_t> found;
  for (int i = 0; i < steps; ++i) {
    world.step();
    for (const Event& e : world.events()) {
      if (e.type == EventType::Impact) found.push_back(world.steps());
    }
  }
  return found;
}

TEST(Impact, ABodyThatFallsHitsTheGroundOnceAndNotBefore) {
  Scene scene = onGround();
  add(scene, box(1, 1, {0, 1.5}));  // 1 m above the ground: sqrt(2 / g) = 0.45 s
  for (const Mode mode : {Mode::Reference, Mode::MergeSleep}) {
    const auto impacts = impactsOf(scene, mode, 200);
    ASSERT_THAT(impacts, SizeIs(1)) << name(mode);
    EXPECT_NEAR(static_cast<double>(impacts[0]), 45.0, 1.0) << name(mode);
  }
}

/// In its last free step it comes near just as far as it gets: rounding alone gives it an impulse.
TEST(Impact, ABodyThatGetsThereAtTheEndOfAStepHitsInTheNext) {
  for (const double speed : {1.0, 2.0, 4.0, 5.0}) {  // m/s over 1 m, in steps of 0.01 s
    for (const double restitution : {0.0, 0.5, 1.0}) {
      Scene scene;
      scene.gravity = Vec2::Zero();
      add(scene, disc(0.5, {0, 0}));
      add(scene, disc(0.5, {2, 0}));
      scene.bodies[0].velocity = {speed, 0.0};
      scene.bodies[0].restitution = restitution;
      EXPECT_THAT(impactsOf(scene, Mode::Reference, 150), SizeIs(1)) << speed;
    }
  }
}

TEST(Impact, WhatIsPutDownGentlyMakesNone) {
  EXPECT_THAT(impactsOf(column(3), Mode::MergeSleep, 200), IsEmpty());
}

TEST(Impact, ItsRecordTellsTheSpeed) {
  Scene scene = onGround();
  add(scene, box(1, 1, {0, 1.5}));
  Recorder recorder(scene);
  for (int i = 0; i < 60; ++i) {
    for (const Decision& d : recorder.record().after.decisions) {
      if (d.criterion != "impact") continue;
      EXPECT_NEAR(d.value, std::sqrt(2.0 * kGravity), 2.0 * scene.step * kGravity);
      EXPECT_EQ(d.verdict, "impact");
      return;
    }
  }
  FAIL() << "no impact was recorded";
}

}  // namespace
}  // namespace merge2d
