#include "lessons/hand.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lessons/player_words.h"
#include "lessons/timeline.h"
#include "tests/lessons/live_testing.h"
#include "tests/support/fingerprint.h"

namespace merge2d {
namespace {

using testing::HasSubstr;

std::string say(Live& live, const std::string& line) { return doByHand(live, wordsOf(line)); }
std::string refusal(Live& live, const std::string& line) {
  try {
    say(live, line);
  } catch (const Refusal& refused) {
    return refused.what();
  }
  return "it was done";
}
BodyState stateOf(const Live& live, std::uint32_t body) {
  return live.world().capture().bodies[body];
}

TEST(Hand, APushGivesTheImpulseToABodyByItsNameOrNumber) {
  Live live = stack();
  live.skipTo(50);
  say(live, "push high 2 0");
  say(live, "push @1 -3 0");
  live.skipTo(51);
  EXPECT_GT(stateOf(live, 2).v.x(), 0.5);
  EXPECT_LT(stateOf(live, 1).v.x(), -0.5);
}

TEST(Hand, ADragHoldsUntilItIsDropped) {
  Live live = stack();
  live.skipTo(50);
  EXPECT_EQ(say(live, "drag high to 3 4"), "dragged high to (3.00, 4.00) m");
  live.skipTo(300);
  EXPECT_NEAR(stateOf(live, 2).x.x(), 3.0, 0.05);
  say(live, "drop high");
  live.skipTo(400);
  EXPECT_LT(stateOf(live, 2).x.y(), 1.0);
  EXPECT_THAT(refusal(live, "drop high"), HasSubstr("not being dragged"));
}

TEST(Hand, WhatIsPinnedStaysInTheAir) {
  Live live = stack();
  live.skipTo(50);
  say(live, "pin high");
  say(live, "delete low");
  live.skipTo(150);
  EXPECT_NEAR(stateOf(live, 1).x.y(), 1.5, 0.01);  // the second body now: high
  say(live, "unpin high");
  live.skipTo(300);
  EXPECT_LT(stateOf(live, 1).x.y(), 0.6);
}

TEST(Hand, SetChangesAThresholdFromTheNextStepOn) {
  Live live = stack();
  live.skipTo(50);
  EXPECT_EQ(say(live, "set merging.velocity=0.05"), "merging.velocity: 0.01 → 0.05");
  EXPECT_DOUBLE_EQ(live.world().settings().merging.velocity, 0.05);
  say(live, "set gravity=[0, -1]");
  EXPECT_DOUBLE_EQ(live.world().gravity().y(), -1.0);
  say(live, "set mode=reference");
  live.skipTo(60);
  EXPECT_EQ(live.world().stats().collections, 0);
}

TEST(Hand, SetChangesTheTimeStepAndTimeGoesOnFromThere) {
  Live live = stack();
  live.skipTo(50);
  EXPECT_EQ(say(live, "set step=0.004"), "step: 0.01 s → 0.004 s");
  live.skipTo(75);
  EXPECT_NEAR(live.world().time(), 0.5 + 0.1, 1e-12);
  const Live::Saved saved = live.save();
  say(live, "set step=0.02");
  live.skipTo(80);
  live.restore(saved);
  EXPECT_EQ(live.world().timeStep(), 0.004);
  live.skipTo(100);
  EXPECT_NEAR(live.world().time(), 0.5 + 0.2, 1e-12);
}

TEST(Hand, AHandHoldsABodyUpWhateverTheTimeStepIs) {
  for (const char* h : {"0.001", "0.01", "0.05"}) {
    Live live = stack();
    live.skipTo(20);
    say(live, std::string("set step=") + h);
    say(live, "drag high to 0 4");
    live.skipTo(20 + static_cast<int>(3.0 / live.world().timeStep()));
    // A spring that would swing with 12 rad/s, critically damped, implicit in the step.
    const double way = 12.0 * live.world().timeStep();
    const double sag = 9.81 / (12.0 * 12.0) * (1.0 + 2.0 * way + way * way);
    EXPECT_NEAR(stateOf(live, 2).x.y(), 4.0 - sag, 1e-3) << h;
  }
}

TEST(Hand, WithoutFrictionAPushedBodySlidesOff) {
  Live rough = stack(), icy = stack();
  for (Live* live : {&rough, &icy}) live->skipTo(50);
  say(icy, "set friction=0");
  for (Live* live : {&rough, &icy}) {
    say(*live, "push high 1 0");
    live->skipTo(100);
  }
  EXPECT_GT(stateOf(icy, 2).x.x(), stateOf(rough, 2).x.x() + 0.2);
}

TEST(Hand, AddedBodiesFallAndCanBeNamed) {
  Live live = stack();
  say(live, "add disc 4 2 0.3");
  EXPECT_EQ(say(live, "add box 6 2 1 0.5"), "added body5");
  live.skipTo(200);
  EXPECT_NEAR(stateOf(live, 3).x.y(), 0.3, 0.02);
  EXPECT_NEAR(stateOf(live, 4).x.y(), 0.25, 0.02);
}

TEST(Hand, ARefusalSaysWhatWouldBeRightAndChangesNothing) {
  Live live = stack();
  live.skipTo(20);
  EXPECT_THAT(refusal(live, "push hihg 1 0"), HasSubstr("did you mean 'high'?"));
  EXPECT_THAT(refusal(live, "push high 1"), HasSubstr("it should read: push BODY X Y"));
  EXPECT_THAT(refusal(live, "push high 1 x"), HasSubstr("'x' is not a number"));
  EXPECT_THAT(refusal(live, "push high nan 0"), HasSubstr("not a number"));
  EXPECT_THAT(refusal(live, "drag high at 1 2"), HasSubstr("'to' is expected"));
  EXPECT_THAT(refusal(live, "set merging.velocty=1"), HasSubstr("did you mean 'velocity'?"));
  EXPECT_THAT(refusal(live, "set merging.velocity=-1"), HasSubstr("merging.velocity"));
  EXPECT_THAT(refusal(live, "set mode=merg"), HasSubstr("did you mean 'merge'?"));
  EXPECT_THAT(refusal(live, "set duration=3"), HasSubstr("cannot be changed while it runs"));
  EXPECT_THAT(refusal(live, "set step=0"), HasSubstr("between 1e-6 and 1 s"));
  EXPECT_THAT(refusal(live, "set step=2"), HasSubstr("between 1e-6 and 1 s"));
  EXPECT_THAT(refusal(live, "add cone 0 0"), HasSubstr("a box or a disc"));
  EXPECT_THAT(refusal(live, "add disc 0 0 -1"), HasSubstr("not a length"));
  EXPECT_THAT(refusal(live, "push @7 1 0"), HasSubstr("there is no body '@7'"));
  EXPECT_THAT(refusal(live, "throw ground 1 0"), HasSubstr("pinned"));
  Live untouched = stack();
  untouched.skipTo(20);
  EXPECT_EQ(Fingerprint(live.world().capture()), Fingerprint(untouched.world().capture()));
}

/// Steps of a run with changes, as they are seen at first.
std::vector<Fingerprint> goThrough(Timeline& run, std::int64_t last) {
  std::vector<Fingerprint> seen;
  for (std::int64_t k = 1; k <= last; ++k) seen.emplace_back(run.step(k).after);
  return seen;
}

TEST(Timeline, GoesBackThroughChangesAndOnAgainBitForBit) {
  Timeline run(stackScene(), Mode::MergeSleep, 1000);
  run.change(60, {"push", "high", "2", "1"});
  run.change(70, {"add", "disc", "0", "4", "0.3"});
  run.change(90, {"drag", "low", "to", "2", "3"});
  run.change(110, {"set", "merging.velocity=0.1"});
  run.change(120, {"drop", "low"});
  const std::vector<Fingerprint> seen = goThrough(run, 200);
  for (const std::int64_t k : {199, 125, 111, 95, 75, 61, 20, 130, 200}) {
    EXPECT_EQ(Fingerprint(run.step(k).after), seen[static_cast<std::size_t>(k - 1)]) << k;
  }
}

TEST(Timeline, AChangeForgetsWhatCameLater) {
  Timeline run(stackScene(), Mode::MergeSleep, 1000);
  run.change(60, {"push", "high", "2", "1"});
  run.step(100);
  run.change(40, {"pin", "high"});
  ASSERT_EQ(run.changes().size(), 1);
  EXPECT_EQ(run.changes()[0].told, "pinned high");
  EXPECT_NEAR(run.step(100).after.bodies[2].x.x(), 0.0, 1e-9);
}

TEST(Timeline, UndoRunsAgainWithoutTheLastChanges) {
  const Scene scene = stackScene();
  Timeline run(scene, Mode::MergeSleep, 1000), untouched(scene, Mode::MergeSleep, 1000);
  run.change(55, {"set", "mode=reference"});
  run.change(60, {"push", "high", "2", "1"});
  run.change(61, {"add", "box", "0", "5"});
  run.step(150);
  EXPECT_EQ(run.undo(3), 55);
  EXPECT_EQ(Fingerprint(run.step(150).after), Fingerprint(untouched.step(150).after));
  EXPECT_EQ(run.undo(), std::nullopt);
  EXPECT_EQ(run.bodies().size(), 3);
}

TEST(Timeline, ARefusedChangeLeavesTheRunAsItWas) {
  const Scene scene = stackScene();
  Timeline run(scene, Mode::MergeSleep, 1000), untouched(scene, Mode::MergeSleep, 1000);
  run.step(80);
  EXPECT_THROW(run.change(50, {"push", "nobody", "1", "0"}), Refusal);
  EXPECT_TRUE(run.changes().empty());
  EXPECT_EQ(Fingerprint(run.step(100).after), Fingerprint(untouched.step(100).after));
}

}  // namespace
}  // namespace merge2d
