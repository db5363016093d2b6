/// Collections that are hit for long (docs/decisions/decided.md).

#include <gtest/gtest.h>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

/// Three planks on the ground, and light discs that fall on the highest, one in each other step.
class RainOnPlanks {
 public:
  RainOnPlanks(Mode mode, const std::string& step)
      : run_(kGround + R"(
[[body]]
name = "plank"
at = [0, 0.5]
box = [30, 1]
repeat = { count = [1, 3], spacing = [1, 1] }
)",
             mode, {{"step", step}}) {
    run_.until(1.0);
  }

  void rain(double time) {
    constexpr double kRadius = 0.05, kAbove = 0.01, kApart = 0.2;
    for (const double end = run_.world().time() + time; run_.world().time() < end - 1e-9;) {
      BodyDesc disc;
      disc.at = {kApart * drops_++ - 14.0, 3.0 + kRadius + kAbove};
      disc.velocity = {0.0, -3.0};
      disc.shapes = {Circle{.radius = kRadius}};
      disc.density = 1e-3;
      run_.world().addBody(disc);
      run_.steps(2);
    }
  }

  /// Whether all planks are in one collection.
  bool areOne() const {
    const CollectionId one = run_.collectionOf("plank[0,0]");
    return one != kNoCollection && run_.collectionOf("plank[0,1]") == one &&
           run_.collectionOf("plank[0,2]") == one;
  }
  bool areSingle() const {
    return !run_.merged("plank[0,0]") && !run_.merged("plank[0,1]") && !run_.merged("plank[0,2]");
  }
  Simulation& run() { return run_; }

 private:
  Simulation run_;
  int drops_ = 0;
};

/// The discs fall so softly that nothing moves: only their number tells.
TEST(StepBack, BodiesThatAreHitForLongAreSimulatedOneByOne) {
  for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
    for (const char* step : {"0.016666666666666666", "0.01", "0.0025"}) {
      SCOPED_TRACE(name(mode) + std::string(" ") + step);
      RainOnPlanks planks(mode, step);
      planks.rain(0.05);
      EXPECT_TRUE(planks.areOne());
      planks.rain(0.06);
      EXPECT_TRUE(planks.areSingle());
      planks.run().steps(5);
      EXPECT_TRUE(planks.areSingle());
      planks.run().steps(30);
      EXPECT_TRUE(planks.areOne()) << "they rest";
    }
  }
}

TEST(StepBack, AfterABreakTheTimeOfHitsBeginsAnew) {
  RainOnPlanks planks(Mode::Merge, "0.01");
  for (int i = 0; i < 4; ++i) {
    planks.rain(0.06);
    planks.run().steps(5);
    EXPECT_TRUE(planks.areOne());
  }
}

TEST(StepBack, TheTimeOfHitsIsPartOfASavedState) {
  RainOnPlanks whole(Mode::Merge, "0.01"), restored(Mode::Merge, "0.01");
  whole.rain(0.06), restored.rain(0.06);
  restored.run().world().restore(restored.run().world().save(), "state");
  whole.rain(0.04), restored.rain(0.04);
  EXPECT_TRUE(whole.areSingle());
  EXPECT_TRUE(restored.areSingle());
}

/// A hand pulls by an impulse in each step.
TEST(StepBack, ImpulsesInEachStepLeaveACollectionWhole) {
  RainOnPlanks planks(Mode::Merge, "0.01");
  for (int i = 0; i < 50; ++i) {
    planks.run().kick("plank[0,2]", {1e-6, 0.0});
    planks.run().steps(1);
    EXPECT_TRUE(planks.areOne());
  }
}

/// A hinge makes two boxes one only where contacts hold them as well.
TEST(StepBack, AHingeDoesNotHoldWhatIsHitForLong) {
  Simulation run(kGround + R"(
[[body]]
name = "box"
at = [-0.5, 0.5]
box = [1, 1]
repeat = { count = [2, 1], spacing = [1, 1] }
[[joint]]
kind = "revolute"
bodies = ["box[0,0]", "box[1,0]"]
at = [0, 1]
)",
                 Mode::Merge);
  run.until(1.0);
  ASSERT_TRUE(run.merged("box[0,0]"));
  for (int i = 0; i < 12; ++i) {
    BodyDesc disc;
    disc.at = {0.12 * i - 0.9, 1.06};
    disc.velocity = {0.0, -3.0};
    disc.shapes = {Circle{.radius = 0.05}};
    disc.density = 1e-3;
    run.world().addBody(disc);
    run.steps(1);
  }
  EXPECT_FALSE(run.merged("box[0,0]"));
  EXPECT_FALSE(run.merged("box[1,0]"));
}

}  // namespace
}  // namespace merge2d
