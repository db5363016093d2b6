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

TEST_F(WordsTest, TellsWhyAThresholdIsRaised) {
  EXPECT_EQ(said({.criterion = "relative-motion",
                  .equation = "(17)",
                  .value = 0.16,
                  .threshold = 0.64,
                  .caution = 32.0}),
            "relative motion 0.16 m/s is below 0.64 m/s (25 %; Eq. 17; 32 times the usual limit, "
            "as the pair was cut in vain before)");
}

TEST_F(WordsTest, TellsSmallThresholdsInMillimetres) {
  EXPECT_EQ(said({.criterion = "breathing",
                  .equation = "Section 5.3",
                  .value = 3.6e-5,
                  .threshold = 1e-5}),
            "the change of overlap 0.036 mm per step is above 0.010 mm per step (3.6 times; "
            "Section 5.3)");
}

TEST_F(WordsTest, TellsOverHowManyStepsSlipWasSummed) {
  EXPECT_EQ(said({.stage = "Unmerge",
                  .criterion = "sliding",
                  .equation = "(19)",
                  .value = 0.028,
                  .threshold = 0.01,
                  .count = 4}),
            "the slip of a contact, summed over 4 steps, 0.028 m/s is above 0.010 m/s (2.8 times; "
            "Eq. 19)");
}

TEST_F(WordsTest, TellsOverHowManyStepsAPivotGatheredSpeed) {
  EXPECT_EQ(said({.stage = "Unmerge",
                  .criterion = "relative-motion",
                  .equation = "(17)",
                  .value = 0.03,
                  .threshold = 0.02,
                  .count = 5}),
            "relative motion, summed over 5 steps, 0.030 m/s is above 0.020 m/s (1.5 times; "
            "Eq. 17)");
}

TEST_F(WordsTest, TellsOfABodyThatABlowCarriesOff) {
  EXPECT_EQ(said({.stage = "Unmerge",
                  .criterion = "carried-off",
                  .equation = "(17)",
                  .value = 0.19,
                  .threshold = 0.03,
                  .count = 1}),
            "the motion of one of them against the whole 0.19 m/s is above 0.030 m/s (6.3 times; "
            "Eq. 17)");
}

TEST_F(WordsTest, TellsHowLongAPairThatPartedMustWait) {
  EXPECT_EQ(said({.stage = "AccumulateRelativeMotion", .criterion = "patience", .value = 7.0}),
            "their last weld broke too early, or turned slowly: 7 steps to wait");
}

TEST_F(WordsTest, TellsHowMuchOfTheConeIsUsed) {
  EXPECT_EQ(said({.stage = "Unmerge",
                  .criterion = "cone",
                  .equation = "(20)",
                  .value = 0.3,
                  .threshold = 0.4,
                  .verdict = "keep"}),
            "friction 0.30 N s of the 0.40 N s that the pressure allows (75 %; Eq. 20)");
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
  Decision d{
      .stage = "Merge", .criterion = "cycle", .value = 1, .threshold = 2, .verdict = "merge"};
  d.group = 1;
  EXPECT_THAT(words.test(d), testing::HasSubstr("the rigid group of b ("));
  d.members = 0;
  EXPECT_THAT(words.test(d, {group(3)}), testing::HasSubstr("the rigid group of a, b and c ("));
  d.stage = "Unmerge";
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
