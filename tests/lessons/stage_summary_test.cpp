/// The work of a stage in one line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lessons/tables.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

using testing::HasSubstr;

/// A column of five boxes, merged by then, that a disc hits.
StepRecord stepOfAHit() {
  Scene scene = column(5);
  BodyDesc shot = disc(0.4, {-12, 2.5});
  shot.velocity = {20, 2};
  add(scene, shot);
  Recorder recorder(scene, Mode::Merge);
  for (int i = 0; i < 200; ++i) {
    StepRecord record = recorder.record();
    for (const Event& event : record.after.events) {
      if (event.type == EventType::Impact) return record;
    }
  }
  throw std::logic_error("the disc misses the column");
}

TEST(StageSummary, TellsOfOpenCollectionsInTheStepOfAHit) {
  const StepRecord record = stepOfAHit();
  EXPECT_EQ(summary(record, Stage::WarmStart),
            "1 collection open: their bodies are solved one by one");
  EXPECT_EQ(result(record, Stage::WarmStart), "1 opened");
}

/// Each contact between rigid things sticks, slides or carries nothing.
TEST(StageSummary, CountsTheContactsOfTheFullSolveByTheirStates) {
  const StepRecord record = stepOfAHit();
  std::size_t between = 0;
  for (const ContactView& c : record[Stage::SolveLCP].after.contacts) between += !c.internal;
  ASSERT_GT(between, 0u);
  const std::string text = summary(record, Stage::SolveLCP);
  EXPECT_THAT(text, HasSubstr(std::to_string(between) + " contact"));
  const auto inside = static_cast<std::size_t>(record.after.stats.contacts) - between;
  ASSERT_GT(inside, 0u) << "nothing is open";
  EXPECT_EQ(result(record, Stage::SolveLCP),
            std::to_string(between) + " between, " + std::to_string(inside) + " inside");
}

/// The rows inside a collection that is opened are solved too.
TEST(StageSummary, ContactsInTheFullSolveAreAlsoThoseOfOpenCollections) {
  const StepRecord record = stepOfAHit();
  EXPECT_GE(record.after.stats.contacts, 10);  // five pairs of points, and the disc's
}

}  // namespace
}  // namespace merge2d
