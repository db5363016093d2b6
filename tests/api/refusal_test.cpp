/// Calls that are refused, and the messages that say why.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <merge2d/merge2d.h>

#include <cmath>
#include <limits>
#include <thread>

#include "api_testing.h"

namespace {

using merge2d::Scene;
using merge2d::Shape;
using merge2d::World;
using merge2d::testing_api::refusal;
using merge2d::testing_api::towerOf;
using ::testing::HasSubstr;

TEST(PublicRefusals, NumbersAndNamesThatMakeNoSense) {
  World world(towerOf(1));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal([&] { world.at({nan, 0.0}); }), HasSubstr("finite"));
  EXPECT_THAT(refusal([&] { world.setPose(7, {0.0, 0.0}, 0.0); }), HasSubstr("no body 7"));
  EXPECT_THAT(refusal([&] { world.find("bxo 0"); }), HasSubstr("did you mean 'box 0'"));
  EXPECT_THAT(refusal([&] { world.set("merging.velocty", 0.1); }),
              HasSubstr("did you mean 'merging.velocity'"));
  EXPECT_THAT(refusal([&] { world.set("merging.velocity", -1.0); }), HasSubstr("0 or more"));
  EXPECT_THAT(refusal([&] { world.set("gravity", "[0, 0]"); }),
              HasSubstr("'gravity' is of the scene, not a setting of a world: set its gravity"));
  EXPECT_THAT(refusal([&] {
                world.inBox({1.0, 1.0}, {0.0, 2.0});
              }),
              HasSubstr("the lower corner of a box is left of and below the upper one"));
  EXPECT_THAT(refusal([&] { world.why(1, 1); }), HasSubstr("no pair"));
  EXPECT_THAT(refusal([&] { world.restore("rubbish"); }), HasSubstr("saved state"));
}

TEST(PublicRefusals, ActionsOfASceneHaveFiniteNumbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](auto&& add) {
    Scene scene = towerOf(1);
    add(scene);
    return refusal([&] { World world(scene); });
  };
  EXPECT_EQ(refused([](Scene&) {}), "accepted");
  EXPECT_EQ(refused([](Scene& s) {
              s.addForce(1, {0.0, 0.0}, {1.0, 0.0}, 0.0, HUGE_VAL);
            }),
            "accepted");
  EXPECT_EQ(refused([&](Scene& s) {
              s.addForce(1, {0.0, 0.0}, {nan, 0.0});
            }),
            "'force[0]' in force[0] must be a finite number below 1e12 in size, but is nan");
  EXPECT_THAT(refused([&](Scene& s) {
                s.addForce(1, {0.0, 0.0}, {1.0, 0.0}, 0.0, nan);
              }),
              HasSubstr("'until' in force[0] must be a finite number"));
  EXPECT_THAT(refused([&](Scene& s) {
                s.addImpulse(1, {0.0, 0.0}, {1.0, HUGE_VAL}, 0.0);
              }),
              HasSubstr("'impulse[1]' in impulse[0] must be a finite number"));
  EXPECT_THAT(refused([&](Scene& s) { s.addMagnet(1, nan); }),
              HasSubstr("'on' in magnet[0] must be a finite number"));
}

TEST(PublicRefusals, AChangeOfARunHasFiniteNumbers) {
  World world(towerOf(1));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refuses = [](auto&& work) { EXPECT_THAT(refusal(work), HasSubstr("finite")); };
  refuses([&] { world.applyForce(1, {0.0, 0.0}, {nan, 0.0}); });
  refuses([&] { world.applyImpulse(1, {0.0, nan}, {1.0, 0.0}); });
  refuses([&] { world.setPose(1, {0.0, 0.0}, HUGE_VAL); });
  refuses([&] { world.setVelocity(1, {0.0, 0.0}, nan); });
  refuses([&] { world.setFriction(1, nan); });
  refuses([&] { world.setGravity({0.0, nan}); });
  refuses([&] { world.setTimeStep(nan); });
  refuses([&] { world.set("merging.velocity", nan); });
  auto spring = merge2d::springDef();
  spring.body = 1;
  spring.stiffness = nan;
  refuses([&] { world.add(spring); });
  auto joint = merge2d::jointDef();
  joint.a = 1;
  joint.at = {nan, 0.0};
  refuses([&] { world.add(joint); });
}

TEST(PublicRefusals, ANameStandsForOneBodyOfARun) {
  World world(towerOf(2));
  const auto add = [&](const char* name) {
    world.add({.name = name, .position = {9.0, 9.0}, .shapes = {Shape::circle(0.5)}});
  };
  EXPECT_THAT(refusal([&] { add("box 1"); }), HasSubstr("two bodies are called 'box 1'"));
  world.removeBody(world.find("box 1"));
  EXPECT_THAT(refusal([&] { add("box 1"); }), HasSubstr("two bodies are called 'box 1'"));
  add("");
  add("");
  add("box 2");
  EXPECT_EQ(world.find("box 2"), 5U);
}

TEST(PublicRefusals, KeepsTheMessageOfEachThread) {
  Scene scene;
  EXPECT_EQ(m2_scene_set(scene.get(), "stpe", "1"), M2_INPUT_ERROR);
  std::thread([] { EXPECT_STREQ(m2_error(), ""); }).join();
  EXPECT_THAT(m2_error(), HasSubstr("stpe"));
}

TEST(PublicRefusals, NullPointersAreErrors) {
  EXPECT_EQ(m2_world_step(nullptr, 1), M2_INPUT_ERROR);
  EXPECT_EQ(m2_world_new(nullptr, M2_MERGE, nullptr), M2_INPUT_ERROR);
  EXPECT_EQ(m2_scene_load(nullptr, nullptr, 0, nullptr), M2_INPUT_ERROR);
  EXPECT_EQ(m2_world_watch_poses(nullptr), nullptr);
  EXPECT_TRUE(std::isnan(m2_world_time(nullptr)));
  EXPECT_TRUE(std::isnan(m2_world_time_step(nullptr)));
  EXPECT_TRUE(std::isnan(m2_world_gravity(nullptr).y));
  EXPECT_EQ(m2_world_steps(nullptr), -1);
  EXPECT_EQ(m2_world_mode(nullptr), M2_REFERENCE);
  EXPECT_EQ(m2_world_body_count(nullptr), 0U);
  EXPECT_EQ(m2_scene_body_count(nullptr), 0U);
  m2_scene_free(nullptr);
  m2_world_free(nullptr);
  m2_free(nullptr);
}

TEST(PublicRefusals, AMovedFromOneRefusesEverything) {
  const auto take = [](auto& from) { return std::move(from); };
  Scene scene = towerOf(1);
  World world(scene);
  const World kept = take(world);
  EXPECT_EQ(kept.steps(), 0);
  EXPECT_NE(refusal([&] { world.step(); }), "accepted");
  EXPECT_NE(refusal([&] { world.time(); }), "accepted");
  EXPECT_NE(refusal([&] { world.mode(); }), "accepted");
  EXPECT_NE(refusal([&] { world.gravity(); }), "accepted");
  EXPECT_NE(refusal([&] { world.bodyCount(); }), "accepted");
  EXPECT_NE(refusal([&] { world.poses(); }), "accepted");
  EXPECT_NE(refusal([&] { world.contacts(); }), "accepted");
  EXPECT_NE(refusal([&] { world.draw(); }), "accepted");
  const Scene moved = take(scene);
  EXPECT_NE(refusal([&] { scene.bodyCount(); }), "accepted");
  EXPECT_NE(refusal([&] { World refused(scene); }), "accepted");
  world = World(moved);
  world.step();
  EXPECT_EQ(world.steps(), 1);
}

}  // namespace
