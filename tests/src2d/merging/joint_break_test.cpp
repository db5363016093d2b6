/// Joints that break inside a collection.

#include <fmt/format.h>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

/// A plate over two posts, with a ball welded on top of it.
std::string ballOnPlate(double height, double speed) {
  return fmt::format(R"(
format = 1
[[body]]
name = "posts"
motion = "pinned"
shapes = [{{ box = [0.2, 1], at = [-0.9, -0.5] }}, {{ box = [0.2, 1], at = [0.9, -0.5] }}]
[[body]]
name = "plate"
at = [0, {0}]
box = [2, 0.1]
velocity = [0, {2}]
[[body]]
name = "ball"
at = [0, {1}]
circle = 0.05
velocity = [0, {2}]
[[joint]]
kind = "weld"
bodies = ["plate", "ball"]
at = [0, {0}]
break_force = 5
)",
                     height + 0.05, height + 0.15, -speed);
}

TEST(JointBreak, WhatTheJointHeldDoesNotPassThroughItsBody) {
  for (const Mode mode : {Mode::Reference, Mode::Merge, Mode::MergeSleep}) {
    Simulation struck(ballOnPlate(0.0, 0.0), mode);
    struck.until(0.5);
    struck.kick("ball", {0.0, -0.3});
    struck.until(1.5);
    EXPECT_EQ(struck.count(EventType::Break), 1) << name(mode);
    EXPECT_NEAR(struck.body("ball").x.y(), 0.15, 2e-3) << name(mode);

    Simulation landed(ballOnPlate(2.0, 20.0), mode);
    landed.until(1.0);
    EXPECT_EQ(landed.count(EventType::Break), 1) << name(mode);
    EXPECT_NEAR(landed.body("ball").x.y(), 0.15, 2e-3) << name(mode);
  }
}

TEST(JointBreak, PassesOnTheBlowThatBreaksItAsWithoutMerging) {
  const std::string toml = R"(
format = 1
gravity = [0, 0]
[[body]]
name = "a"
box = [1, 0.2]
[[body]]
name = "b"
at = [1, 0]
box = [1, 0.2]
[[joint]]
kind = "weld"
bodies = ["a", "b"]
at = [0.5, 0]
break_force = 40
)";
  Simulation reference(toml, Mode::Reference), merging(toml, Mode::Merge);
  for (Simulation* run : {&reference, &merging}) {
    run->until(0.5);
    run->kick("b", {0.0, -10.0});
    run->until(1.0);
    EXPECT_EQ(run->count(EventType::Break), 1);
  }
  ASSERT_EQ(merging.count(EventType::Merge), 1);
  for (const char* name : {"a", "b"}) {
    EXPECT_LT((merging.body(name).v - reference.body(name).v).norm(), 1e-6) << name;
    EXPECT_NEAR(merging.body(name).omega, reference.body(name).omega, 1e-6) << name;
  }
}

std::string weldOf(const std::string& a, const std::string& b, double at) {
  return fmt::format("[[joint]]\nkind = \"weld\"\nbodies = [\"{}\", \"{}\"]\nat = [{}, 0.4]\n", a,
                     b, at);
}

/// Six planks in a row between two banks; a load falls on the middle.
std::string bridge() {
  std::string toml = R"(
format = 1
[[body]]
name = "banks"
motion = "pinned"
shapes = [{ box = [4, 1], at = [-5, 0] }, { box = [4, 1], at = [5, 0] }]
[[body]]
name = "plank"
at = [-2.5, 0.4]
box = [1, 0.2]
repeat = { count = [6, 1], spacing = [1, 0] }
[[body]]
name = "load"
at = [0, 3]
box = [0.8, 0.8]
mass = 1
)";
  for (int i = 0; i < 5; ++i) {
    toml += weldOf(fmt::format("plank[{},0]", i), fmt::format("plank[{},0]", i + 1), i - 2);
    toml += "break_force = 400\nbreak_torque = 6\n";
  }
  return toml + weldOf("banks", "plank[0,0]", -3) + weldOf("banks", "plank[5,0]", 3);
}

TEST(JointBreak, EachJointOfABridgeTellsOnceThatItBroke) {
  for (const Mode mode : {Mode::Reference, Mode::Merge, Mode::MergeSleep}) {
    Simulation run(bridge(), mode);
    std::map<std::pair<BodyId, BodyId>, int> breaks;
    run.steps(200, [&] {
      for (const Event& e : run.world().events()) breaks[{e.a, e.b}] += e.type == EventType::Break;
    });
    EXPECT_GT(run.count(EventType::Break), 0) << name(mode);
    for (const auto& [pair, times] : breaks) EXPECT_LE(times, 1) << name(mode);
  }
}

TEST(JointBreak, AResumedRunBreaksItAsTheOneThatItContinues) {
  for (const Overrides& rules : {Overrides{}, kPaper}) {
    Simulation whole(ballOnPlate(0.0, 0.0), Mode::Merge, rules);
    whole.until(0.5);
    Simulation resumed(ballOnPlate(0.0, 0.0), Mode::Merge, rules);
    resumed.world().restore(whole.world().save(), "whole");
    for (Simulation* run : {&whole, &resumed}) {
      run->kick("ball", {0.0, -0.3});
      run->steps(50);
      EXPECT_EQ(run->count(EventType::Break), 1);
    }
    EXPECT_EQ(whole.world().save(), resumed.world().save());
  }
}

TEST(JointBreak, BreaksUnderALoadThatComesLater) {
  Simulation run(R"(
format = 1
[[body]]
name = "wall"
motion = "pinned"
at = [-0.5, 0]
box = [1, 1]
[[body]]
name = "beam"
at = [0.5, 0]
box = [1, 0.2]
mass = 2
[[joint]]
kind = "weld"
bodies = ["wall", "beam"]
at = [0, 0]
break_force = 30
[[force]]
body = "beam"
force = [0, -20]
from = 2
)",
                 Mode::Merge);
  run.until(1.9);
  EXPECT_TRUE(run.merged("beam"));
  run.until(2.1);
  EXPECT_FALSE(run.merged("beam"));
  EXPECT_TRUE(run.now().joints[0].broken);
  EXPECT_EQ(run.count(EventType::Unmerge), 1);
  EXPECT_EQ(run.count(EventType::Break), 1);
  run.until(2.5);
  EXPECT_LT(run.body("beam").x.y(), -1.0);
}

TEST(JointBreak, TheBodiesPartThoughTheyMayTouch) {
  // The load hangs under a slab that rests on two pillars, and may touch it.
  Simulation run(R"(
format = 1
[[body]]
name = "left"
motion = "pinned"
at = [-1, 0]
box = [0.2, 1]
[[body]]
name = "right"
motion = "pinned"
at = [1, 0]
box = [0.2, 1]
[[body]]
name = "slab"
at = [0, 0.6]
box = [3, 0.2]
mass = 3
[[body]]
name = "load"
at = [0, 0.4]
box = [0.2, 0.2]
mass = 1
[[joint]]
kind = "weld"
bodies = ["slab", "load"]
at = [0, 0.5]
break_force = 15
collide = true
[[force]]
body = "load"
force = [0, -20]
from = 1.0
until = 1.2
)",
                 Mode::Merge);
  run.until(0.9);
  EXPECT_TRUE(run.merged("load"));
  run.until(1.1);
  EXPECT_EQ(run.count(EventType::Break), 1);
  EXPECT_FALSE(run.merged("load"));
  run.until(2.0);
  EXPECT_LT(run.body("load").x.y(), -1.0);
}

}  // namespace
}  // namespace merge2d
