/// The public interface, used as a program outside of this project does.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <merge2d/merge2d.h>

#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "api_testing.h"

namespace {

using merge2d::Body;
using merge2d::Scene;
using merge2d::Shape;
using merge2d::World;
using merge2d::testing_api::refusal;
using merge2d::testing_api::towerOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(PublicWorld, ATowerBecomesOneCollection) {
  World world(towerOf(4));
  world.step(200);
  const auto collections = world.collections();
  ASSERT_EQ(collections.size(), 1U);
  EXPECT_THAT(collections[0].bodies, ElementsAre(1, 2, 3, 4));
  EXPECT_EQ(collections[0].anchor, 0U);
  EXPECT_NEAR(collections[0].mass, 4.0, 1e-12);
  EXPECT_EQ(world.collectionOf(3), collections[0].id);
  EXPECT_EQ(world.counts().collections, 1);
}

TEST(PublicWorld, WatchedArraysFollowTheWorldWhereTheyAre) {
  World world(towerOf(3));
  const auto poses = world.poses();
  const auto ids = world.collectionIds();
  for (int i = 0; i < 50; ++i) {
    world.step();
    std::vector<double> copy(poses.size());
    ASSERT_EQ(m2_world_poses(world.get(), copy.data(), copy.size()), M2_OK);
    ASSERT_TRUE(std::equal(copy.begin(), copy.end(), poses.begin()));
  }
  world.setPose(2, {5.0, 0.5}, 0.0);
  EXPECT_EQ(poses[6], 5.0);
  for (int i = 0; i < 1000; ++i) {
    world.add({.position = {10.0 + 2.0 * i, 0.5}, .shapes = {Shape::circle(0.5)}});
  }
  world.step();
  EXPECT_EQ(world.poses().data(), poses.data()) << "they have moved";
  EXPECT_EQ(world.collectionIds().data(), ids.data()) << "they have moved";
  EXPECT_EQ(world.poses().size(), 3U * 1004);
}

TEST(PublicWorld, ABodyThatIsNotThereHasNoNumbers) {
  World world(towerOf(2));
  world.removeBody(1);
  EXPECT_TRUE(std::isnan(world.poses()[3]));
  EXPECT_EQ(world.collectionIds()[1], -1);
  EXPECT_FALSE(world.info(1).present);
  EXPECT_TRUE(world.info(2).present);
  EXPECT_THAT(refusal([&] {
                world.setPose(1, {0.0, 0.0}, 0.0);
              }),
              HasSubstr("body 1 ('box 0') is not in the world"));
}

TEST(PublicWorld, ABodyWithoutANameGoesByItsNumber) {
  Scene scene;
  scene.add({.shapes = {Shape::circle(0.5)}});
  World world(scene);
  world.removeBody(0);
  EXPECT_THAT(refusal([&] { world.drag(0, {0.0, 0.0}); }), HasSubstr("body 0 is not in the world"));
}

TEST(PublicWorld, ContinuesFromASavedStateBitForBit) {
  World world(towerOf(5));
  world.step(20);
  const std::string saved = world.save();
  world.step(100);
  World other(towerOf(5));
  other.restore(saved);
  other.step(100);
  EXPECT_TRUE(std::equal(world.poses().begin(), world.poses().end(), other.poses().begin()));
  EXPECT_EQ(world.save(), other.save());
}

TEST(PublicWorld, RestoresUnderOtherSettingsWhereThatIsSaid) {
  World world(towerOf(3));
  world.step(20);
  Scene scene = towerOf(3);
  scene.set("merging.velocity", 0.05);
  World other(scene, merge2d::Mode::Reference);
  EXPECT_THAT(refusal([&] { other.restore(world.save()); }), HasSubstr("saved"));
  other.restore(world.save(), true);
  EXPECT_EQ(other.steps(), 20);
  EXPECT_EQ(other.mode(), merge2d::Mode::Reference);
  EXPECT_EQ(other.get("merging.velocity"), "0.05");
}

TEST(PublicWorld, SaysWhyTwoBodiesAreOne) {
  World world(towerOf(2));
  world.step();
  EXPECT_THAT(refusal([&] { world.why(1, 2); }), HasSubstr("did not note its decisions"));
  EXPECT_THAT(refusal([&] { world.decisions(); }), HasSubstr("did not note its decisions"));
  world.noteDecisions();
  world.step();
  EXPECT_THAT(world.why(2, 1), HasSubstr("box 0 and box 1"));
  ASSERT_FALSE(world.decisions().empty());
  std::vector<std::string> sources;
  for (const merge2d::Decision& d : world.decisions()) {
    EXPECT_STRNE(d.stage, "");
    EXPECT_STRNE(d.criterion, "");
    EXPECT_STRNE(d.verdict, "");
    sources.emplace_back(d.equation);
  }
  EXPECT_THAT(sources, testing::Contains("docs/decisions/cures.md#when-to-merge")) << "in full";
}

TEST(PublicWorld, NamesEveryReasonOfAnUnmerge) {
  std::vector<std::string> names;
  for (int reason = M2_REASON_NONE; reason <= M2_REASON_USER; ++reason) {
    names.emplace_back(m2_reason_name(static_cast<m2_reason>(reason)));
  }
  EXPECT_THAT(names, ElementsAre("none", "broken", "sliding", "relative-motion", "user"));
  EXPECT_STREQ(m2_reason_name(static_cast<m2_reason>(M2_REASON_USER + 1)), "unknown");
}

TEST(PublicWorld, TellsContactsAndEvents) {
  World world(towerOf(1));
  bool merged = false;
  for (int i = 0; i < 100 && !merged; ++i) {
    world.step();
    for (const merge2d::Event& event : world.events()) {
      merged = merged || (event.type == M2_EVENT_MERGE && event.a == 0 && event.b == 1);
    }
  }
  EXPECT_TRUE(merged);
  ASSERT_EQ(world.contacts().size(), 2U);
  double weight = 0.0;
  for (const merge2d::Contact& c : world.contacts()) {
    EXPECT_NEAR(c.ny, 1.0, 1e-9) << "from the ground to the box";
    weight += c.lambda_n / world.timeStep();
  }
  EXPECT_NEAR(weight, 9.81, 0.2);
}

TEST(PublicWorld, IsDraggedByASpringAndLetGo) {
  World world(towerOf(2));
  world.step(50);
  const merge2d::Spring hand = world.drag(2, {0.5, 1.5});
  for (int i = 0; i < 100; ++i) {
    world.moveSpring(hand, {0.5 + 0.02 * i, 3.0});
    world.step();
  }
  EXPECT_GT(world.poses()[6], 1.0);
  EXPECT_GT(world.poses()[7], 2.0);
  world.removeSpring(hand);
  world.step(200);
  EXPECT_LT(world.poses()[7], 1.7);
}

TEST(PublicWorld, ADragHoldsTheVeryPointThatItGrips) {
  Scene scene;
  scene.set("gravity", "[0, 0]");
  // The centre of mass is not the origin of the body's frame.
  scene.add({.position = {3.0, 1.0},
             .angle = 0.7,
             .shapes = {Shape::box(1.0, 1.0), Shape::box(1.0, 1.0, {1.0, 0.0})}});
  World world(scene);
  const double x = world.poses()[0], y = world.poses()[1];
  world.drag(0, {x + 0.2, y + 0.1});
  world.step(100);
  EXPECT_NEAR(world.poses()[0], x, 1e-9) << "it rests where it was gripped";
  EXPECT_NEAR(world.poses()[1], y, 1e-9);
}

TEST(PublicWorld, TheTimeStepCanBeChangedBetweenTwoSteps) {
  World world(towerOf(2));
  world.step(100);
  const double h = world.timeStep();
  world.setTimeStep(h / 4);
  EXPECT_EQ(world.timeStep(), h / 4);
  const std::string state = world.save();
  world.step(100);
  EXPECT_NEAR(world.time(), 125 * h, 1e-9);
  World other(towerOf(2));
  EXPECT_THAT(refusal([&] { other.restore(state); }), HasSubstr("other parameters"));
  other.setTimeStep(h / 4);
  other.restore(state);
  other.step(100);
  EXPECT_EQ(other.save(), world.save());
  for (const double wrong : {0.0, -h, 2.0}) {
    EXPECT_THAT(refusal([&] { world.setTimeStep(wrong); }), HasSubstr("between 1e-6 and 1 s"));
  }
}

TEST(PublicWorld, ASpringPullsByHooke) {
  Scene scene;
  scene.set("gravity", "[0, 0]");
  const Body ball = scene.add({.shapes = {Shape::circle(0.5)}});
  merge2d::SpringDef pull = merge2d::springDef();
  pull.body = ball;
  pull.to = {3.0, 4.0};
  pull.stiffness = 2.0;
  pull.rest_length = 1.0;
  scene.add(pull);
  World world(scene);
  EXPECT_TRUE(world.springs().empty()) << "none has acted yet";
  world.step();
  ASSERT_EQ(world.springs().size(), 1U);
  const merge2d::SpringState& spring = world.springs()[0];
  EXPECT_EQ(spring.number, 0U);
  EXPECT_EQ(spring.a, ball);
  EXPECT_EQ(spring.b, M2_NO_BODY);
  EXPECT_DOUBLE_EQ(spring.bx, 3.0);
  EXPECT_NEAR(spring.force, 2.0 * (5.0 - 1.0), 1e-12);
}

TEST(PublicWorld, SettingsAreReadAsTheyWereSet) {
  World world(towerOf(1));
  world.set("merging.velocity", 0.0123);
  EXPECT_EQ(world.get("merging.velocity"), "0.0123");
  EXPECT_EQ(world.get("merging.rule"), "default");
  world.set("merging.rule", "paper");
  EXPECT_EQ(world.get("merging.rule"), "paper");
  EXPECT_EQ(world.get("unmerging.ordering"), "true");
  EXPECT_EQ(world.get("merging.velocity"), "0.0123") << "others keep their values";
}

TEST(PublicWorld, TwoThreadsStepTwoWorldsToTheSameBits) {
  World one(towerOf(8)), other(towerOf(8));
  std::thread thread([&] { other.step(200); });
  one.step(200);
  thread.join();
  EXPECT_EQ(one.save(), other.save());
}

TEST(PublicWorld, TellsWhatJointsBear) {
  Scene scene;
  const Body bob =
      scene.add({.position = {1.0, 2.0}, .shapes = {Shape::box(1.0, 1.0)}, .mass = 3.0});
  auto joint = merge2d::jointDef();
  joint.a = bob;
  joint.at = {1.0, 2.5};
  scene.add(joint);
  World world(scene);
  world.step(100);
  ASSERT_EQ(world.joints().size(), 1U);
  const merge2d::JointState state = world.joints()[0];
  EXPECT_EQ(state.kind, M2_REVOLUTE);
  EXPECT_EQ(state.b, M2_NO_BODY);
  EXPECT_NEAR(state.ay, 2.5, 1e-3);
  EXPECT_NEAR(std::hypot(state.fx, state.fy), 3.0 * 9.81, 0.1);
  world.removeJoint(0);
  world.step(10);
  EXPECT_LT(world.poses()[1], 1.99) << "it falls";
}

}  // namespace
