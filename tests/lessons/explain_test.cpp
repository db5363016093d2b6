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
using testing::Not;

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

TEST(Explain, SaysWhichPartOfALoadTheKnownOnesLeaveOver) {
  World world(column(3), kAsking);
  const auto all = firstStepWith(world, Outcome::Carried);
  const std::string text = textOf(all, Outcome::Carried);
  EXPECT_THAT(text, HasSubstr("C1 (body2 and 1 other)"));
  EXPECT_THAT(text, HasSubstr("carries its load at step " + std::to_string(world.steps()) + ": "));
}

TEST(Explain, SaysHowFarTheSearchForALoadHasComeAndWhatEndedIt) {
  World world(column(3), kAsking);
  const auto all = firstStepWith(world, Outcome::Carried);
  const auto e = std::ranges::find(all, Outcome::Carried, &Explanation::outcome);
  ASSERT_NE(e, all.end());
  ASSERT_EQ(e->tests.size(), 2u) << "a first load is sought: no other is known";
  EXPECT_EQ(e->tests.front().criterion, "in-doubt");
  EXPECT_EQ(e->tests.front().verdict, "search");
  EXPECT_EQ(e->tests.back().criterion, "residual");
  EXPECT_EQ(e->tests.back().verdict, "carried");
  EXPECT_LE(e->tests.back().value, e->tests.back().threshold);
  world.step();
  const auto next = explainStep(Words(world.bodies()), world.capture());
  EXPECT_THAT(textOf(next, Outcome::Carried),
              HasSubstr("the part that the one known load leaves over"));
}

TEST(Explain, SaysForHowLongAHitOpensACollection) {
  World world(column(3), kAsking);
  ASSERT_FALSE(firstStepWith(world, Outcome::Carried).empty());
  const BodyId top = *Words(world.bodies()).find("body3");
  world.applyImpulse(top, {0.0, 2.5}, {0.5, 0.0});
  world.step();
  const auto all = explainStep(Words(world.bodies()), world.capture());
  EXPECT_THAT(textOf(all, Outcome::Opened),
              HasSubstr("something hit it 0 steps ago, and a hit opens it for 3 steps"));
}

TEST(Explain, SaysForHowLongAPairWaitsThatPartedSlowly) {
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
            "ground and body1 wait at step 20: their last weld turned slowly, or was hit for long: "
            "7 steps to wait.");
  EXPECT_EQ(conditionOf(all.at(0)).steps, 7);
}

TEST(Explain, NamesAllThatAPairWaitsFor) {
  const Decision stopped{.a = BodyId{0},
                         .b = BodyId{1},
                         .stage = "AccumulateRelativeMotion",
                         .criterion = "stopped",
                         .value = 7e-3,
                         .threshold = 1e-3,
                         .verdict = "wait"};
  Decision patience = stopped, slow = stopped;
  patience.criterion = "patience", patience.value = 111.0, patience.threshold = 0.0;
  slow.criterion = "relative-motion", slow.verdict = "below", slow.count = -110, slow.needed = 3;
  slow.value = 0.0;
  Snapshot after;
  after.step = 20;
  after.decisions = {stopped, patience, slow};
  const World world(column(1));
  const std::string text = textOf(explainStep(Words(world.bodies()), after), Outcome::Waiting);
  EXPECT_THAT(text, HasSubstr("the motion of the waiting pair"));
  EXPECT_THAT(text, HasSubstr("111 steps to wait"));
  EXPECT_THAT(text, Not(HasSubstr("-110")));
}

TEST(Explain, CountsNothingForAPairOnABelt) {
  const Decision belt{.a = BodyId{0},
                      .b = BodyId{1},
                      .stage = "AccumulateRelativeMotion",
                      .criterion = "belt",
                      .value = 1.0,
                      .verdict = "apart"};
  Snapshot after;
  after.step = 20;
  after.decisions = {belt};
  const World world(column(1));
  EXPECT_THAT(textOf(explainStep(Words(world.bodies()), after), Outcome::Apart),
              Not(HasSubstr("count")));
}

/// A plank lies on a block on the ground and on a step on a platform, which drives away too slowly
/// for any criterion to see. All that merges is on the ground: the platform and the step never do.
Scene plankOnTwoFrames(double speed = 0.001) {
  Scene scene = onGround();
  const auto drive = [&](double time) { return Vec2(6.0 + speed * time, -0.5); };
  add(scene, named("platform", scripted(box(4, 1, drive(0)),
                                        Keyframes{{{0, drive(0), 0}, {100, drive(100), 0}}})));
  add(scene, named("block", box(1, 0.4, {0, 0.2})));
  add(scene, named("step", box(1, 0.4, {6, 0.2})));
  add(scene, named("plank", box(8, 0.2, {3, 0.5})));
  return scene;
}

/// Adds two boxes at rest that a joint holds together.
Scene joinedBoxes(Scene scene, JointKind kind, bool collide = false) {
  const double x = collide ? 1.0 : 3.0;
  JointDesc joint;
  joint.kind = kind;
  joint.a = scene.bodies.size();
  joint.b = joint.a + 1;
  joint.at = {0, 0.5};
  joint.to = {x, 0.5};
  joint.collide = collide;
  add(scene, named("left", box(1, 1, {0, 0.5})));
  add(scene, named("right", box(1, 1, {x, 0.5})));
  scene.joints.push_back(joint);
  return scene;
}

using Pairs = std::set<std::pair<BodyId, BodyId>>;

Pairs welded(const Snapshot& s) {
  Pairs pairs;
  for (const WeldView& weld : s.welds) pairs.insert(std::minmax(weld.a, weld.b));
  return pairs;
}

/// Runs a scene and compares the pairs that are told as merged with the welds and the events.
void expectToldAsItIs(const Scene& scene, int steps) {
  World world(scene, kAsking);
  const Words words(world.bodies());
  for (int i = 0; i < steps; ++i) {
    world.step();
    const Snapshot after = world.capture();
    const Pairs welds = welded(after);
    Pairs told;
    for (const Explanation& e : explainStep(words, after)) {
      if (e.outcome == Outcome::Waiting) {
        EXPECT_THAT(e.text, Not(HasSubstr("but only for 3 of 3"))) << e.text;
      }
      if (e.outcome != Outcome::Merged) continue;
      told.emplace(e.a, e.b);
      ASSERT_TRUE(welds.contains({e.a, e.b})) << e.text;
    }
    for (const Event& e : after.events) {
      if (e.type != EventType::Merge) continue;
      ASSERT_TRUE(told.contains({e.a, e.b}))
          << words.pair(e.a, e.b) << " merged at step " << after.step;
    }
  }
}

TEST(Explain, TellsAPairAsMergedOnlyWhereItIsWelded) {
  for (const CycleCriterion cycles :
       {CycleCriterion::Off, CycleCriterion::Triangle, CycleCriterion::Rigid}) {
    for (const Scene& made :
         {plankOnTwoFrames(), wall(3, 3), joinedBoxes(onGround(), JointKind::Distance),
          joinedBoxes(onGround(), JointKind::Revolute), joinedBoxes(onGround(), JointKind::Weld),
          joinedBoxes(onGround(), JointKind::Distance, true),
          joinedBoxes(onGround(), JointKind::Weld, true), loadScene("truss-arch"),
          loadScene("books"), loadScene("wagon")}) {
      Scene scene = made;
      scene.settings.merging.cycles = cycles;
      expectToldAsItIs(scene, 150);
      scene.settings.merging.rule = MergingRule::Paper;
      expectToldAsItIs(scene, 150);
    }
  }
}

TEST(Explain, SaysThatARodHoldsNoPair) {
  World world(joinedBoxes(noGravity(), JointKind::Distance), kAsking);
  runSteps(world, 5);
  const std::string text =
      textOf(explainStep(Words(world.bodies()), world.capture()), Outcome::Waiting);
  EXPECT_EQ(text,
            "left and right did not merge at step 5, though they passed every test for 3 steps: "
            "their joints take away 1 of 3 freedoms, too few to hold them "
            "(docs/decisions/cures.md#when-to-merge).");
}

TEST(Explain, SaysThatAPairIsOnTwoFrames) {
  World world(plankOnTwoFrames(), kAsking);
  runSteps(world, 100);
  const Words words(world.bodies());
  const auto all = explainStep(words, world.capture());
  EXPECT_EQ(textOf(all, Outcome::Apart),
            "platform and step stayed apart at step 100: they are on two frames, those of platform "
            "and ground, which may move against each other.");
  const auto told = std::ranges::find(all, Outcome::Apart, &Explanation::outcome);
  EXPECT_EQ(conditionOf(*told).kind, Condition::Kind::OneFrame);
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
    EXPECT_THAT(chapter.what.tests, Not(IsEmpty()));
    EXPECT_NE(chapter.what.reason, EventReason::None);
    EXPECT_THAT(chapter.what.text, HasSubstr("its contacts pressed and did not slide"));
  }
}

/// The tests before the weld tell nothing of why the pair is apart after it.
TEST(WeldStory, CountsTheTestsSinceAWeldEnded) {
  World world(pushedColumn(), kAsking);
  const Words words(world.bodies());
  const WeldStory story = storyOf(world, words, BodyId{2}, BodyId{3}, 215);
  ASSERT_FALSE(story.welded());
  EXPECT_THAT(story.ending(), HasSubstr(" since step 201; "));
  EXPECT_THAT(story.ending(), HasSubstr("the count never left 0 of 3"));
}

TEST(WeldStory, TellsThatAPairNeverTouched) {
  World world(column(2), kAsking);
  const Words words(world.bodies());
  const WeldStory story = storyOf(world, words, BodyId{0}, BodyId{2}, 20);
  EXPECT_THAT(story.ending(), HasSubstr("Nothing was tested: they did not touch."));
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

TEST(WeldStory, TellsThatAPairIsOnTwoFrames) {
  World world(plankOnTwoFrames(), kAsking);
  const Words words(world.bodies());
  const WeldStory story = storyOf(world, words, idOf(world, "platform"), idOf(world, "step"), 100);
  EXPECT_FALSE(story.welded());
  EXPECT_THAT(story.ending(), HasSubstr("What mostly kept them apart, in "));
  EXPECT_THAT(story.ending(), HasSubstr("they are on two frames, which may move"));
}

}  // namespace
}  // namespace merge2d
