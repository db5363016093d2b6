#include "lessons/keyframes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "lessons/impulses.h"
#include "lessons/recording.h"
#include "src2d/scene/load.h"

namespace merge2d {
namespace {

/// A box and a disc fall on two boxes that merge with each other; a lamp swings.
constexpr const char* kMixed = R"(
format = 1
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [20, 1]
[[body]]
name = "low"
at = [0, 0.5]
box = [1, 1]
[[body]]
name = "high"
at = [0, 1.5]
box = [1, 1]
[[body]]
name = "falling"
at = [0.3, 4]
angle = 20
box = [1, 1]
[[body]]
name = "ball"
at = [-4, 3]
velocity = [1, 0]
circle = 0.3
[[body]]
name = "lamp"
at = [6, 4]
box = [0.6, 0.6]
[[joint]]
kind = "revolute"
bodies = ["lamp"]
at = [8, 4]
)";
constexpr std::int64_t kMixedSteps = 400;

Scene mixedScene() { return parseScene(kMixed, "mixed.toml"); }

Recording inFull() {
  Recording recording = record(mixedScene(), {.steps = kMixedSteps});
  lookInside(recording);
  return recording;
}

Recording inKeyframes(std::int64_t with_contacts = 6 * kMixedSteps / 5) {
  return record(mixedScene(),
                {.steps = kMixedSteps, .most_in_full = 100, .most_with_contacts = with_contacts});
}

/// On the straight way between two keyframes, as the page shows it.
double shownBetween(const BodyTrack& t, const std::vector<double>& column, std::size_t i,
                    std::int64_t step) {
  if (i + 1 >= t.at.size()) return column[i];
  const double part =
      static_cast<double>(step - t.at[i]) / static_cast<double>(t.at[i + 1] - t.at[i]);
  return column[i] + part * (column[i + 1] - column[i]);
}

TEST(Keyframes, BodiesStayCloseToWhereTheyWere) {
  const Recording full = inFull(), kept = inKeyframes();
  const double tolerance = 0.02 * 0.3 * std::numbers::sqrt2 + 1e-9;  // of the smallest body
  for (std::size_t i = 0; i < full.tracks.size(); ++i) {
    const BodyId id{static_cast<std::uint32_t>(i)};
    for (std::int64_t step = 0; step <= kMixedSteps; ++step) {
      const BodyTrack &is = full.tracks[i], &shown = kept.tracks[i];
      const std::size_t exact = full.sample(id, step), key = kept.sample(id, step);
      EXPECT_NEAR(shownBetween(shown, shown.x, key, step), is.x[exact], tolerance)
          << i << " " << step;
      EXPECT_NEAR(shownBetween(shown, shown.y, key, step), is.y[exact], tolerance)
          << i << " " << step;
    }
  }
}

TEST(Keyframes, AreFew) {
  const Recording kept = inKeyframes();
  EXPECT_LE(kept.tracks[0].at.size(), 2u) << "the ground";
  EXPECT_LE(kept.tracks[5].at.size(), kMixedSteps / 5u) << "the lamp, which swings all the time";
}

TEST(Keyframes, CollectionsChangeInTheStepInWhichTheyDid) {
  const Recording full = inFull(), kept = inKeyframes();
  bool merged = false;
  for (std::uint32_t i = 0; i < full.bodies.size(); ++i) {
    for (std::int64_t step = 0; step <= kMixedSteps; ++step) {
      const CollectionId is = full.collection(BodyId{i}, step);
      EXPECT_EQ(kept.collection(BodyId{i}, step), is) << i << " " << step;
      merged |= is != kNoCollection;
    }
  }
  EXPECT_TRUE(merged);
}

TEST(Keyframes, BodiesAreThereFromTheFirstStepToTheLast) {
  const Recording kept = inKeyframes();
  EXPECT_TRUE(kept.present(BodyId{1}, 0));
  EXPECT_TRUE(kept.present(BodyId{1}, kMixedSteps));
  EXPECT_FALSE(kept.present(BodyId{1}, kMixedSteps + 1));
}

TEST(LongRecording, HasTheSameEventsAsAFullOne) {
  const Recording full = inFull(), kept = inKeyframes();
  ASSERT_EQ(kept.events.size(), full.events.size());
  for (std::size_t i = 0; i < full.events.size(); ++i) {
    EXPECT_EQ(kept.events[i].step, full.events[i].step);
    EXPECT_EQ(kept.events[i].event.type, full.events[i].event.type);
  }
}

TEST(LongRecording, KeepsContactsAsTheyWereEverySoManySteps) {
  const Recording full = inFull(), kept = inKeyframes();
  ASSERT_EQ(kept.every, 5);
  int compared = 0;
  for (const ContactTrack& t : kept.contacts) {
    const auto same = std::ranges::find_if(full.contacts, [&](const ContactTrack& other) {
      return other.a == t.a && other.b == t.b && other.feature == t.feature;
    });
    ASSERT_NE(same, full.contacts.end());
    for (std::int64_t step = 0; step <= kMixedSteps; step += 5) {
      const auto exact = full.sampleAt(same->spans, step), sample = kept.sampleAt(t.spans, step);
      ASSERT_EQ(exact.has_value(), sample.has_value()) << step;
      if (!sample) continue;
      EXPECT_EQ(t.lambda_n[*sample], same->lambda_n[*exact]);
      EXPECT_EQ(t.x[*sample], same->x[*exact]);
      ++compared;
    }
  }
  EXPECT_GT(compared, 50);
}

TEST(LongRecording, LooksIntoTheStepsWhoseContactsItKeeps) {
  const Recording full = inFull(), kept = inKeyframes();
  ASSERT_FALSE(kept.inside.empty());
  for (const ImpulsesInside& inside : kept.inside) {
    EXPECT_EQ(inside.step % kept.every, 0);
    const auto same = std::ranges::find(full.inside, inside.step, &ImpulsesInside::step);
    ASSERT_NE(same, full.inside.end());
    EXPECT_EQ(inside.sweeping, same->sweeping);
    EXPECT_EQ(inside.contact.size(), same->contact.size());
  }
}

TEST(LongRecording, OfTheMotionAloneHasNoContacts) {
  const Recording kept =
      record(mixedScene(), {.detail = Detail::Motion, .steps = kMixedSteps, .most_in_full = 100});
  EXPECT_GT(kept.every, 1);
  EXPECT_TRUE(kept.contacts.empty());
  EXPECT_TRUE(kept.inside.empty());
  EXPECT_FALSE(kept.tracks[3].at.empty());
}

TEST(LongRecording, BeginsWhereTheStatesWouldBeTooMany) {
  EXPECT_EQ(record(mixedScene(), {.steps = 10, .most_in_full = 60}).every, 1);
  EXPECT_GT(record(mixedScene(), {.steps = 10, .most_in_full = 59}).every, 1);
}

}  // namespace
}  // namespace merge2d
