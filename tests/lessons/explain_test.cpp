#include "lessons/explain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "lessons/story.h"
#include "lessons/why.h"
#include "src2d/world.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

const WorldOptions kAsking{.mode = Mode::MergeSleep, .timings = false, .decisions = true};

/// The explanations of the first step in which one has this outcome.
std::vector<Explanation> firstStepWith(World& world, Outcome outcome, int steps = 500) {
  const Words words(world.bodies());
  for (int i = 0; i < steps; ++i) {
    world.step();
    auto all = explainStep(words, world.capture());
    const bool found =
        std::ranges::any_of(all, [&](const Explanation& e) { return e.outcome == outcome; });
    if (found) return all;
  }
  return {};
}

std::string textOf(const std::vector<Explanation>& all, Outcome outcome) {
  const auto found = std::ranges::find(all, outcome, &Explanation::outcome);
  return found == all.end() ? "" : found->text;
}

TEST(Explain, SaysForHowLongAMergedPairWasStill) {
  World world(column(1), kAsking);
  const std::string text = textOf(firstStepWith(world, Outcome::Merged), Outcome::Merged);
  EXPECT_THAT(text, HasSubstr("ground and body1 merged at step " + std::to_string(world.steps()) +
                              " into C1: they passed every test for 3 of 3 steps."));
  EXPECT_THAT(text, HasSubstr("Eq. 17"));
}

TEST(Explain, SaysWhatKeepsASlidingPairApart) {
  Scene scene = column(1);
  scene.bodies[1].velocity = {3.0, 0.0};
  World world(scene, kAsking);
  const std::string text = textOf(firstStepWith(world, Outcome::Apart), Outcome::Apart);
  EXPECT_THAT(text, HasSubstr("ground and body1 stayed apart at step "));
  EXPECT_THAT(text, HasSubstr("m/s is above 0.010 m/s"));
  EXPECT_THAT(text, HasSubstr("the count stays at 0 of 3."));
}

TEST(Explain, SaysThatAPairIsStillCounting) {
  World world(column(1), kAsking);
  const std::string text = textOf(firstStepWith(world, Outcome::Waiting), Outcome::Waiting);
  EXPECT_THAT(text, HasSubstr("they passed every test, but only for 1 of 3 steps."));
}

TEST(Explain, SaysForHowLongAPairWaitsWhoseWeldBrokeEarly) {
  const Decision patience{.a = BodyId{0},
                          .b = BodyId{1},
                          .stage = "AccumulateRelativeMotion",
                          .criterion = "patience",
                          .value = 7.0,
                          .verdict = "wait"};
  Decision slow = patience;
  slow.criterion = "relative-motion", slow.verdict = "below", slow.count = -6, slow.needed = 3;
  Snapshot after;
  after.step = 20;
  after.decisions = {patience, slow};
  const World world(column(1));
  const std::vector<Explanation> all = explainStep(Words(world.bodies()), after);
  EXPECT_EQ(textOf(all, Outcome::Waiting),
            "ground and body1 wait at step 20: their last weld broke too early, turned slowly, or "
            "was hit for long: "
            "7 steps to wait.");
  EXPECT_EQ(conditionOf(all.at(0)).steps, 7);
}

/// A column is pushed over at its top: welds end.
Scene pushedColumn() {
  Scene scene = column(3);
  scene.impulses.push_back({.body = 3, .at = {0.0, 3.0}, .impulse = {3.0, 0.0}, .time = 2.0});
  return scene;
}

TEST(Explain, EveryUnmergeEventHasItsExplanation) {
  World world(pushedColumn(), kAsking);
  const Words words(world.bodies());
  int ended = 0;
  for (int i = 0; i < 300; ++i) {
    world.step();
    const Snapshot after = world.capture();
    std::set<std::pair<BodyId, BodyId>> explained;
    for (const Explanation& e : explainStep(words, after)) {
      if (e.outcome == Outcome::CameApart) explained.emplace(e.a, e.b);
    }
    std::set<std::pair<BodyId, BodyId>> happened;
    for (const Event& e : after.events) {
      if (e.type == EventType::Unmerge) happened.emplace(e.a, e.b);
    }
    EXPECT_EQ(explained, happened) << "step " << world.steps();
    ended += static_cast<int>(happened.size());
  }
  EXPECT_GT(ended, 0);
}

TEST(Explain, SaysWhySomethingFallsAsleep) {
  World world(column(1), kAsking);
  const std::string text = textOf(firstStepWith(world, Outcome::Slept), Outcome::Slept);
  EXPECT_THAT(text, HasSubstr("fell asleep at step "));
  EXPECT_THAT(text, HasSubstr("at rest for 3 of 3 steps"));
}

WeldStory storyOf(World& world, const Words& words, BodyId a, BodyId b, int steps) {
  WeldStory story(words, a, b);
  for (int i = 0; i < steps; ++i) {
    world.step();
    story.add(world.capture());
  }
  return story;
}

TEST(WeldStory, TellsWhenItFormedAndWhyItBroke) {
  World world(pushedColumn(), kAsking);
  const Words words(world.bodies());
  const WeldStory story = storyOf(world, words, BodyId{2}, BodyId{3}, 215);
  std::vector<Outcome> outcomes;
  for (const Chapter& chapter : story.chapters()) outcomes.push_back(chapter.what.outcome);
  EXPECT_THAT(outcomes, Contains(Outcome::Merged));
  EXPECT_THAT(outcomes, Contains(Outcome::CameApart));
  for (const Chapter& chapter : story.chapters()) {
    if (chapter.what.outcome != Outcome::CameApart) continue;
    EXPECT_GE(chapter.step, 200);
    EXPECT_THAT(chapter.what.tests, testing::Not(IsEmpty()));
  }
}

TEST(WeldStory, TellsWhatKeepsAWeldFromForming) {
  Scene scene = column(1);
  scene.bodies[0].friction = scene.bodies[1].friction = 0.0;
  scene.bodies[1].velocity = {0.5, 0.0};
  World world(scene, kAsking);
  const Words words(world.bodies());
  const WeldStory story = storyOf(world, words, BodyId{0}, BodyId{1}, 100);
  EXPECT_FALSE(story.welded());
  EXPECT_THAT(story.ending(), HasSubstr("ground and body1 are not welded"));
  EXPECT_THAT(story.ending(), HasSubstr("the count never left 0 of 3"));
  EXPECT_THAT(story.ending(), HasSubstr("They merge when every test is passed for 3 steps."));
}

}  // namespace
}  // namespace merge2d
