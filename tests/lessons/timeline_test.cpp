#include "lessons/timeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/fingerprint.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

bool isMerge(const Event& e) { return e.type == EventType::Merge; }

TEST(Timeline, ShowsWhatAWorldDoes) {
  Timeline timeline(column(2), Mode::MergeSleep, 100);
  World world(column(2), {.timings = false});
  for (int k = 1; k <= 100; ++k) {
    world.step();
    ASSERT_EQ(Fingerprint(timeline.state(k)), Fingerprint(world.capture())) << k;
  }
}

TEST(Timeline, GoingBackShowsTheSameAgainHoweverFar) {
  Timeline timeline(column(2), Mode::MergeSleep, 200);
  const Fingerprint early(timeline.step(5).after);
  const Fingerprint stage(timeline.step(5)[Stage::SolveLCP].after);
  timeline.step(200);
  EXPECT_EQ(Fingerprint(timeline.step(5).after), early);
  EXPECT_EQ(Fingerprint(timeline.step(5)[Stage::SolveLCP].after), stage);
  const Fingerprint late(timeline.step(199).after);
  EXPECT_EQ(Fingerprint(timeline.step(199).after), late);
  EXPECT_EQ(timeline.step(199).step, 199);
}

TEST(Timeline, FindsEventsInBothDirections) {
  Timeline timeline(column(1), Mode::Merge, 300);
  const auto merge = timeline.nextEvent(0, isMerge);
  ASSERT_TRUE(merge.has_value());
  EXPECT_THAT(timeline.step(*merge).after.events, testing::Contains(testing::Truly(isMerge)));
  EXPECT_EQ(timeline.nextEvent(*merge, isMerge), std::nullopt);
  EXPECT_EQ(timeline.previousEvent(300, isMerge), merge);
  EXPECT_EQ(timeline.previousEvent(*merge, isMerge), std::nullopt);
}

}  // namespace
}  // namespace merge2d
