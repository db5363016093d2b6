#include "lessons/why.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "lessons/tables.h"
#include "lessons/timeline.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class WhyTest : public testing::Test {
 protected:
  PairReason reason(std::int64_t k, std::uint32_t a, std::uint32_t b) {
    const Words words(run.bodies());
    return reasonFor(words, run.state(k), BodyId{a}, BodyId{b});
  }
  std::int64_t firstMerge() {
    return run.nextEvent(0, [](const Event& e) { return e.type == EventType::Merge; }).value();
  }

  Timeline run{column(3), Mode::Merge, 400};
};

TEST_F(WhyTest, APairThatWaitsSaysForHowManySteps) {
  const std::int64_t merge = firstMerge();
  const std::vector<Event> events = run.step(merge).after.events;
  const Event first =
      *std::ranges::find(events, EventType::Merge, [](const Event& e) { return e.type; });
  const PairReason why = reason(merge - 1, static_cast<std::uint32_t>(std::min(first.a, first.b)),
                                static_cast<std::uint32_t>(std::max(first.a, first.b)));
  EXPECT_THAT(sentence(why.condition), AllOf(HasSubstr("They merge when"), HasSubstr("more step")));
}

TEST_F(WhyTest, AWeldThatHoldsSaysWhatWouldEndIt) {
  const PairReason why = reason(300, 1, 2);
  EXPECT_EQ(why.heading, "One collection");
  EXPECT_THAT(why.text, HasSubstr("no motion inside was found"));
  EXPECT_EQ(reason(300, 0, 1).heading, "One collection") << "pinned, and a member of none";
  EXPECT_THAT(sentence(why.condition), HasSubstr("They come apart when"));
}

TEST(WhyOfThePapersRule, AWeldThatHoldsSaysWhatWouldEndIt) {
  Scene scene = column(3);
  scene.settings.unmerging.rule = UnmergingRule::Paper;
  Timeline run(scene, Mode::Merge, 400);
  const PairReason why = reasonFor(Words(run.bodies()), run.state(300), BodyId{1}, BodyId{2});
  EXPECT_EQ(why.heading, "Welds that hold");
  EXPECT_THAT(sentence(why.condition), HasSubstr("They come apart when"));
}

TEST_F(WhyTest, BodiesThatDoNotTouchAreToldApartOrTogether) {
  EXPECT_THAT(reason(300, 1, 3).text, HasSubstr("though they do not touch"));
  EXPECT_THAT(reason(1, 1, 3).text, HasSubstr("do not touch"));
  EXPECT_THAT(sentence(reason(1, 1, 3).condition), HasSubstr("Only bodies that touch"));
}

TEST_F(WhyTest, IsWrittenWithItsTests) {
  const Words words(run.bodies());
  JsonText out;
  writeReason(out, words, reason(firstMerge() - 1, 1, 2));
  const auto written = nlohmann::json::parse(out.text());
  ASSERT_FALSE(written["tests"].empty());
  EXPECT_EQ(written["tests"][0]["criterion"].get<std::string>().empty(), false);
  EXPECT_TRUE(written["tests"][0]["threshold"].is_number());
  EXPECT_EQ(written["outlook"], sentence(reason(firstMerge() - 1, 1, 2).condition));
}

TEST_F(WhyTest, IsToldByNamesAndNumbersTooForOtherLanguages) {
  const auto written = [&](std::int64_t k, std::uint32_t a, std::uint32_t b) {
    JsonText out;
    writeReason(out, Words(run.bodies()), reason(k, a, b));
    return nlohmann::json::parse(out.text());
  };
  const auto held = written(300, 1, 2);
  EXPECT_EQ(held["outcome"], "one");
  EXPECT_EQ(held["condition"]["kind"], "break-slide");
  std::int64_t settled = 1;
  while (settled < 100 && written(settled, 1, 2)["outcome"] == "apart") ++settled;
  const auto soon = written(settled, 1, 2);
  const auto& last = soon["tests"].back();
  EXPECT_EQ(soon["outcome"], "waiting");
  EXPECT_EQ(soon["condition"]["kind"], "below-more");
  EXPECT_EQ(soon["condition"]["steps"], last["needed"].get<int>() - last["count"].get<int>());
  EXPECT_EQ(written(300, 1, 3)["outcome"], "by-others");
  EXPECT_EQ(written(300, 1, 3)["condition"]["kind"], "cut-between");
  EXPECT_EQ(written(1, 1, 3)["outcome"], "no-touch");
  EXPECT_EQ(written(1, 1, 3)["condition"]["kind"], "touch");
}

TEST_F(WhyTest, EachStageTellsItsResultInFewCharacters) {
  for (std::int64_t k = 1; k <= 60; ++k) {
    for (std::size_t i = 0; i < kStages; ++i) {
      const std::string told = result(run.step(k), static_cast<Stage>(i));
      EXPECT_FALSE(told.empty());
      EXPECT_LE(told.size(), 26) << told;
    }
  }
  const std::int64_t merge = firstMerge();
  EXPECT_THAT(result(run.step(merge), Stage::Merge), HasSubstr("merged"));
}

}  // namespace
}  // namespace merge2d
