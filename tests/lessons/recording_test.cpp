#include "lessons/recording.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "src2d/scene/load.h"
#include "src2d/world.h"

namespace merge2d {
namespace {

constexpr const char* kBox = R"(
format = 1
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [10, 1]
[[body]]
name = "box"
at = [0, 0.5]
box = [1, 1]
[[emitter]]
name = "ball"
start = 0.2
every = 1
count = 1
at = [3, 2]
circle = 0.2
)";

Recording recorded(Detail detail = Detail::Full) {
  return record(parseScene(kBox, "box.toml"), {.detail = detail, .steps = 50});
}

TEST(Recording, HoldsTheStateBeforeTheFirstStepAndAfterEach) {
  const Recording r = recorded();
  EXPECT_EQ(r.tracks[0].x.size(), 51u);
  EXPECT_EQ(r.stats.size(), 51u);
}

TEST(Recording, EqualsTheWorldItWatched) {
  const Recording r = recorded();
  World world(parseScene(kBox, "box.toml"));
  for (int i = 0; i < 50; ++i) world.step();
  const Snapshot end = world.capture();
  EXPECT_EQ(r.tracks[1].y.back(), end.bodies[1].x.y());
  EXPECT_EQ(r.collection(BodyId{1}, 50), end.bodies[1].collection);
}

TEST(Recording, AnEmittedBodyBeginsWhenItAppears) {
  const Recording r = recorded();
  const BodyTrack& ball = r.tracks[2];
  EXPECT_GT(ball.first, 10);
  EXPECT_FALSE(r.present(BodyId{2}, ball.first - 1));
  EXPECT_TRUE(r.present(BodyId{2}, ball.first));
}

TEST(Recording, AContactIsKeptWhereItRestsInTheFirstBody) {
  const Recording r = recorded();
  ASSERT_FALSE(r.contacts.empty());
  const ContactTrack& contact = r.contacts[0];
  EXPECT_NEAR(contact.normal[0], 1.5708, 1e-3);  // up, from the ground to the box
  EXPECT_NEAR(contact.y[0], 0.5, 0.01);          // the ground's top, from its centre
  EXPECT_EQ(contact.spans.size(), 1u);
}

TEST(Recording, HoldsTheMotionThatEndsAWeld) {
  Scene scene = parseScene(kBox, "box.toml");
  scene.impulses.push_back({.body = 1, .at = {0.0, 1.0}, .impulse = {3.0, 0.0}, .time = 0.3});
  const Recording r = record(scene, {.detail = Detail::Full, .steps = 50});
  const auto track = std::ranges::find(r.decisions, "motion", &DecisionTrack::criterion);
  ASSERT_NE(track, r.decisions.end());
  EXPECT_EQ(track->stage, "Unmerge");
  EXPECT_GT(track->value.at(0), track->threshold);
  EXPECT_EQ(track->passed.at(0), 0);
}

TEST(Recording, TheMotionAloneHasNeitherContactsNorDecisions) {
  EXPECT_FALSE(recorded().decisions.empty());
  EXPECT_TRUE(recorded(Detail::Motion).contacts.empty());
  EXPECT_TRUE(recorded(Detail::Motion).decisions.empty());
}

}  // namespace
}  // namespace merge2d
