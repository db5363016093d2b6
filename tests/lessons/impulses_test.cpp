#include "lessons/impulses.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "lessons/encode.h"
#include "lessons/recording.h"
#include "src2d/recorder.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

/// A column that is one collection when it is hit at its top, in step 201.
Scene hitColumn() {
  Scene scene = column(4);
  scene.impulses.push_back({.body = 4, .at = {0.0, 4.0}, .impulse = {4.0, 0.0}, .time = 2.0});
  return scene;
}
constexpr std::int64_t kBlow = 201, kSteps = 230;

Recording lookedInto(const Scene& scene, const std::vector<std::int64_t>& wanted = {}) {
  Recording recording = record(scene, {.steps = kSteps});
  lookInside(recording, wanted);
  return recording;
}

const ImpulsesInside& insideOf(const Recording& recording, std::int64_t step) {
  return *std::ranges::find(recording.inside, step, &ImpulsesInside::step);
}

const ContactView* find(const Snapshot& in, const ContactTrack& track) {
  const auto found = std::ranges::find_if(in.contacts, [&](const ContactView& c) {
    return c.a == track.a && c.b == track.b && c.feature == track.feature;
  });
  return found == in.contacts.end() ? nullptr : &*found;
}

TEST(Impulses, AreThoseOfTheStagesInAStepWithABlow) {
  const Scene scene = hitColumn();
  const Recording recording = lookedInto(scene);
  const ImpulsesInside& inside = insideOf(recording, kBlow);
  EXPECT_TRUE(inside.sweeping);
  Recorder recorder(scene);
  recorder.skipTo(kBlow - 1);
  const StepRecord record = recorder.record();
  ASSERT_FALSE(inside.contact.empty());
  for (std::size_t i = 0; i < inside.contact.size(); ++i) {
    const ContactTrack& track = recording.contacts[static_cast<std::size_t>(inside.contact[i])];
    const auto at = [&](Stage stage) { return find(record[stage].after, track); };
    EXPECT_FLOAT_EQ(inside.warm_n[i], static_cast<float>(at(Stage::WarmStart)->lambda_n));
    EXPECT_FLOAT_EQ(inside.warm_t[i], static_cast<float>(at(Stage::WarmStart)->lambda_t));
    EXPECT_FLOAT_EQ(inside.swept_n[i], static_cast<float>(at(Stage::SingleIterationPGS)->lambda_n));
    EXPECT_FLOAT_EQ(inside.swept_t[i], static_cast<float>(at(Stage::SingleIterationPGS)->lambda_t));
  }
}

TEST(Impulses, TheFullSolveBeginsWithThoseAfterUnmergeAndEndsWithThoseOfTheStep) {
  const Scene scene = hitColumn();
  const Recording recording = lookedInto(scene);
  Recorder recorder(scene);
  int compared = 0;
  for (std::int64_t step = 1; step <= kSteps; ++step) {
    const StepRecord record = recorder.record();
    const auto found = std::ranges::find(recording.inside, step, &ImpulsesInside::step);
    if (found == recording.inside.end()) continue;
    for (std::size_t i = 0; i < found->contact.size(); ++i, ++compared) {
      const ContactTrack& track = recording.contacts[static_cast<std::size_t>(found->contact[i])];
      const ContactView* begin = find(record[Stage::Unmerge].after, track);
      EXPECT_FLOAT_EQ(found->begin_n[i], static_cast<float>(begin->lambda_n)) << step;
      // A collection that is open takes part in the full solve before Unmerge.
      const bool outer = found->inner[i] == 0 && !found->sweeping;
      EXPECT_TRUE(!outer || found->begin_n[i] == found->warm_n[i]) << step;
      // The page takes what the solve left from the end of the step.
      const ContactView* solved = find(record[Stage::SolveLCP].after, track);
      EXPECT_EQ(solved->lambda_n, find(record.after, track)->lambda_n) << step;
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST(Impulses, TheSweepAndTheSolveChangeThemInTheStepOfABlow) {
  const Recording recording = lookedInto(hitColumn());
  const ImpulsesInside& inside = insideOf(recording, kBlow);
  EXPECT_NE(inside.warm_n, inside.swept_n);
  EXPECT_NE(inside.warm_t, inside.swept_t);
}

TEST(Impulses, ComeFirstFromTheStepsThatWereWantedThenFromThoseInWhichSomethingHappened) {
  const Recording recording = lookedInto(hitColumn(), {150, 999, 150, 0});
  ASSERT_GT(recording.inside.size(), 2u);
  EXPECT_EQ(recording.inside[0].step, 150);
  const std::int64_t second = recording.inside[1].step;
  EXPECT_TRUE(
      std::ranges::any_of(recording.events, [&](const TimedEvent& e) { return e.step == second; }));
  std::set<std::int64_t> steps;
  for (const ImpulsesInside& inside : recording.inside) steps.insert(inside.step);
  EXPECT_EQ(steps.size(), recording.inside.size());
}

TEST(Impulses, AreNotSweptWhereNothingIsMerged) {
  Recording recording = record(hitColumn(), {.mode = Mode::Reference, .steps = kBlow});
  lookInside(recording);
  const ImpulsesInside& inside = insideOf(recording, kBlow);
  EXPECT_FALSE(inside.sweeping);
  EXPECT_EQ(inside.warm_n, inside.swept_n);
}

TEST(Impulses, TheHeadOfAPageListsTheStepsThatHaveThem) {
  const Recording recording = lookedInto(hitColumn(), {kBlow});
  const auto steps = [&](std::size_t most) {
    const auto head = nlohmann::json::parse(encode(recording, {.impulses = most}).head);
    return head["inside"];
  };
  const std::size_t contacts = insideOf(recording, kBlow).contact.size();
  EXPECT_EQ(steps(kMostImpulses).size(), recording.inside.size());
  EXPECT_EQ(steps(contacts), nlohmann::json::parse(fmt::format("[[{}, {}]]", kBlow, contacts)));
  EXPECT_EQ(steps(0), nlohmann::json::array());
  for (const auto& row : nlohmann::json::parse(
           encode(recording, {.contacts_every = 5, .impulses = kMostImpulses}).head)["inside"]) {
    EXPECT_EQ(row[0].get<int>() % 5, 0) << "its contacts are not in the page";
  }
}

}  // namespace
}  // namespace merge2d
