#include "lessons/words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace merge2d {
namespace {

TEST(ShortNumber, HasTwoDigitsBelowOneAndThreeAbove) {
  EXPECT_EQ(shortNumber(0.0234), "0.023");
  EXPECT_EQ(shortNumber(0.01), "0.010");
  EXPECT_EQ(shortNumber(4.4294), "4.43");
  EXPECT_EQ(shortNumber(118.0), "118");
  EXPECT_EQ(shortNumber(-0.5), "-0.50");
  EXPECT_EQ(shortNumber(0.0), "0");
  EXPECT_EQ(shortNumber(2.34e-9), "2.3e-09");
}

TEST(ShortNumbers, AreLongEnoughToTellTheTwoApart) {
  const NumberPair near = shortNumbers(0.010004, 0.01);
  EXPECT_NE(near.value, near.threshold);
  const NumberPair far = shortNumbers(0.023, 0.01);
  EXPECT_EQ(far.value, "0.023");
  EXPECT_EQ(far.threshold, "0.010");
}

TEST(EquationName, SpeaksOfEquationsAndSections) {
  EXPECT_EQ(equationName("(17)"), "Eq. 17");
  EXPECT_EQ(equationName("Section 6.3"), "Section 6.3");
}

TEST(Listed, JoinsWithCommasAndAnd) {
  EXPECT_EQ(listed({}), "");
  EXPECT_EQ(listed({"a"}), "a");
  EXPECT_EQ(listed({"a", "b", "c"}), "a, b and c");
}

class WordsTest : public testing::Test {
 protected:
  WordsTest() : bodies(3), words(bodies) {
    bodies[0].name = "ground";
    bodies[1].name = "brick[2,3]";
  }
  std::string said(const Decision& d) const { return words.test(d); }

  std::vector<BodyInfo> bodies;
  Words words;
};

TEST_F(WordsTest, TellsValueThresholdAndByHowMuch) {
  EXPECT_EQ(said({.stage = "AccumulateRelativeMotion",
                  .criterion = "relative-motion",
                  .equation = "(17)",
                  .value = 0.023,
                  .threshold = 0.01}),
            "relative motion 0.023 m/s is above 0.010 m/s (2.3 times; Eq. 17)");
  EXPECT_EQ(
      said({.criterion = "relative-motion", .equation = "(17)", .value = 0.004, .threshold = 0.01}),
      "relative motion 0.0040 m/s is below 0.010 m/s (40 %; Eq. 17)");
}

TEST_F(WordsTest, TellsHowFastALoadChanges) {
  EXPECT_EQ(
      said({.criterion = "load", .equation = "(17)", .value = 5.0, .threshold = 2.0}),
      "the impulse between them changes by 5.00 times itself in a second, above 2.00 (Eq. 17)");
}

TEST_F(WordsTest, TellsSmallThresholdsInMillimetres) {
  EXPECT_EQ(said({.criterion = "breathing",
                  .equation = "Section 5.3",
                  .value = 3.6e-5,
                  .threshold = 1e-5}),
            "the change of overlap 0.036 mm per step is above 0.010 mm per step (3.6 times; "
            "Section 5.3)");
}

TEST_F(WordsTest, TellsTheMotionOfAWeldWithThePageOfItsDecision) {
  EXPECT_EQ(said({.stage = "Unmerge",
                  .criterion = "motion",
                  .equation = kOwnDecided,
                  .value = 2e-4,
                  .threshold = 5e-5}),
            "relative motion 0.20 mm/s is above 0.050 mm/s (4.0 times; "
            "docs/decisions/decided.md#decision)");
}

TEST_F(WordsTest, TellsOfAContactThatCarriesNothingAnyMore) {
  EXPECT_EQ(said({.stage = "Unmerge", .criterion = "broken", .equation = "Section 6.3"}),
            "a contact of the weld carries no force any more (Section 6.3)");
}

TEST_F(WordsTest, TellsHowLongHitsHaveGoneOn) {
  EXPECT_EQ(said({.stage = "Unmerge",
                  .criterion = "hits",
                  .equation = kOwnDecided,
                  .value = 0.09,
                  .threshold = 0.08}),
            "hits have gone on for 0.09 s (bodies are simulated one by one after 0.08 s; "
            "docs/decisions/decided.md#decision)");
}

TEST_F(WordsTest, TellsHowLongAPairThatPartedMustWait) {
  EXPECT_EQ(said({.stage = "AccumulateRelativeMotion", .criterion = "patience", .value = 7.0}),
            "their last weld turned slowly, or was hit for long: 7 steps to wait");
}

TEST_F(WordsTest, TellsWhyAReadyPairIsNotTaken) {
  EXPECT_EQ(said({.stage = "Merge", .criterion = "frames", .verdict = "apart"}),
            "they are on two frames, which may move against each other");
  Decision joints{
      .stage = "Merge", .criterion = "freedoms", .value = 1, .threshold = 3, .verdict = "wait"};
  EXPECT_EQ(said(joints), "their joints take away 1 of 3 freedoms, too few to hold them");
  joints.value = 3, joints.verdict = "merge";
  EXPECT_EQ(said(joints), "their joints take away 3 of 3 freedoms");
}

TEST_F(WordsTest, CitesThePageOfARigidGroupAndOfTwoFrames) {
  Decision held{.stage = "Merge",
                .criterion = "cycle",
                .equation = kOwnCycles,
                .value = 1,
                .threshold = 2,
                .verdict = "wait"};
  EXPECT_EQ(said(held),
            "a single contact is a pivot, and no rigid group holds it (docs/cycles.md)");
  held.equation = "Section 8.2";
  EXPECT_EQ(said(held), "a single contact is a pivot, and no rigid group holds it (Section 8.2)");
  EXPECT_EQ(
      said({.stage = "Merge", .criterion = "frames", .equation = kOwnMerging, .verdict = "apart"}),
      "they are on two frames, which may move against each other "
      "(docs/decisions/cures.md#when-to-merge)");
}

TEST_F(WordsTest, SaysThatNothingIsAboutToSlide) {
  EXPECT_EQ(said({.criterion = "edge", .equation = "(20)", .value = 0, .threshold = 2}),
            "none of 2 contacts that press is about to slide (Eq. 20)");
  EXPECT_EQ(said({.criterion = "edge", .equation = "(20)", .value = 0, .threshold = 1}),
            "the one contact that presses is not about to slide (Eq. 20)");
}

TEST_F(WordsTest, TellsForHowLongLoadsHaveBeenSteady) {
  EXPECT_EQ(said({.stage = "AccumulateRelativeMotion",
                  .criterion = "steady",
                  .equation = "Section 7",
                  .value = 0.3,
                  .threshold = 1.0}),
            "it has been slow under steady loads for 0.30 of 1.00 s (Section 7)");
  EXPECT_EQ(said({.stage = "AccumulateRelativeMotion",
                  .criterion = "steady",
                  .equation = "Section 7",
                  .value = 12.0,
                  .threshold = 1.0}),
            "it has been slow under steady loads for 12.0 s, at least 1.00 s (Section 7)");
}

TEST(WordsOfGroups, AreAllTheBodiesOrSomeOfMany) {
  std::vector<BodyInfo> bodies(9);
  for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i].name = std::string(1, char('a' + i));
  const Words words(bodies);
  const auto group = [](std::uint32_t size) {
    Group all;
    for (std::uint32_t i = 0; i < size; ++i) all.push_back(BodyId{i});
    return all;
  };
  EXPECT_EQ(words.group(group(3)), "a, b and c");
  EXPECT_EQ(words.group(group(6)), "a, b, c, d, e and f");
  EXPECT_EQ(words.group(group(9)), "a, b, c, d and 5 others");
  Decision d{.stage = "Merge",
             .criterion = "cycle",
             .equation = kOwnCycles,
             .value = 1,
             .threshold = 2,
             .verdict = "merge"};
  d.group = 1;
  EXPECT_THAT(words.test(d), testing::HasSubstr("the rigid group of b ("));
  d.members = 0;
  EXPECT_THAT(words.test(d, {group(3)}), testing::HasSubstr("the rigid group of a, b and c ("));
  EXPECT_THAT(words.test(d, {group(9)}), testing::HasSubstr("a, b, c, d and 5 others"));
}

TEST_F(WordsTest, FindsBodiesAndSuggestsNames) {
  EXPECT_EQ(words.find("brick[2,3]"), BodyId{1});
  EXPECT_EQ(words.find("brik[2,3]"), std::nullopt);
  EXPECT_EQ(words.suggestion("brik[2,3]"), " (did you mean 'brick[2,3]'?)");
  EXPECT_EQ(words.name(BodyId{2}), "body 2");
}

TEST_F(WordsTest, TellsEvents) {
  const auto said_of = [&](EventType type, EventReason reason = EventReason::None) {
    return words.event({type, BodyId{0}, BodyId{1}, CollectionId{3}, reason});
  };
  EXPECT_EQ(said_of(EventType::Merge), "ground and brick[2,3] merge into C3");
  EXPECT_EQ(said_of(EventType::Unmerge, EventReason::Sliding),
            "ground and brick[2,3] come apart (sliding)");
  EXPECT_EQ(said_of(EventType::Impact), "ground and brick[2,3] hit each other");
  EXPECT_EQ(said_of(EventType::Sleep), "C3 falls asleep");
  EXPECT_EQ(said_of(EventType::Break), "the joint of ground and brick[2,3] breaks");
}

}  // namespace
}  // namespace merge2d
