/// Surface velocity: a belt that runs round a body.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "src2d/dynamics/state.h"
#include "src2d/merging/merge.h"
#include "tests/support/modes_and_steps.h"

namespace merge2d {
namespace {

const std::string kBelt = R"(
[[body]]
name = "belt"
motion = "pinned"
at = [0, -0.5]
box = [200, 1]
surface_velocity = 1.5
)";

std::string boxAt(const std::string& name, double x, double y, const std::string& more = "") {
  return fmt::format("[[body]]\nname = \"{}\"\nat = [{}, {}]\nbox = [0.5, 0.5]\n{}\n", name, x, y,
                     more);
}

// A body that is put on a belt slips for t₀ = v/(μ g) and is then carried: x = v t − v²/(2 μ g).
// The tolerance is one step at the belt's speed.
TEST(Belt, CarriesWhatIsPutOnIt) {
  inEachModeAndStep([](Mode mode, double h) {
    World world = worldOf(kBelt + boxAt("box", 0, 0.25), mode, h);
    runSeconds(world, 6.0);
    const double v = 1.5, lag = v * v / (2.0 * 0.6 * kGravity);
    EXPECT_NEAR(see(world, "box").x.x(), 6.0 * v - lag, v * h);
    EXPECT_NEAR(see(world, "box").v.x(), v, 1e-6);
    EXPECT_NEAR(see(world, "box").x.y(), 0.25, 0.002);
  });
}

TEST(Belt, RunsRoundItsBody) {
  // Of a body in mid-air without weight, each side carries its box clockwise.
  const char* scene = R"(
gravity = [0, 0]
[[body]]
motion = "pinned"
box = [2, 2]
surface_velocity = 1
[[body]]
name = "below"
at = [0, -1.25]
box = [0.5, 0.5]
[[force]]
body = "below"
force = [0, 2]
[[body]]
name = "right"
at = [1.25, 0]
box = [0.5, 0.5]
[[force]]
body = "right"
force = [-2, 0]
)";
  inEachModeAndStep([&](Mode mode, double h) {
    World world = worldOf(scene, mode, h);
    runSeconds(world, 0.5);
    EXPECT_NEAR(see(world, "below").v.x(), -1.0, 1e-3);
    EXPECT_NEAR(see(world, "right").v.y(), -1.0, 1e-3);
  });
}

TEST(Belt, StartsADisc) {
  // Slipping, a disc gains μ g in speed and 2 μ g / r in spin; rolling on the belt, no force is
  // left: v = belt / 3, r ω = 2/3 belt, counter-clockwise.
  inEachModeAndStep([](Mode mode, double h) {
    World world =
        worldOf(kBelt + "[[body]]\nname = \"disc\"\nat = [0, 0.5]\ncircle = 0.5\n", mode, h);
    runSeconds(world, 3.0);
    EXPECT_NEAR(see(world, "disc").v.x(), 0.5, 0.005);
    EXPECT_NEAR(see(world, "disc").omega, 2.0, 0.02);
  });
}

TEST(Belt, WhatStandsOnItMergesAndMovesOn) {
  // Boxes of little friction with the belt, as it would pull the tower's foot away: 0.25 g.
  const std::string low = "friction = 0.1";
  for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
    for (const int rate : {60, 100, 240}) {
      World world = worldOf(
          kBelt + boxAt("lower", 0, 0.25, low) + boxAt("upper", 0, 0.75) + boxAt("top", 0.05, 1.25),
          mode, 1.0 / rate);
      runSeconds(world, 5.0);
      const Snapshot now = world.capture();
      ASSERT_EQ(now.collections.size(), 1u) << "h = 1/" << rate;
      EXPECT_EQ(now.collections[0].bodies.size(), 3u);
      EXPECT_NEAR(now.collections[0].v.x(), 1.5, 1e-4);
    }
  }
}

// However slow the belt is.
TEST(Belt, ASlowOneCarriesToo) {
  inEachModeAndStep([](Mode mode, double h) {
    World world = worldOf(
        "[[body]]\nmotion = \"pinned\"\nat = [0, -0.5]\nbox = [20, 1]\n"
        "surface_velocity = -0.004\n" +
            boxAt("box", 0, 0.25),
        mode, h);
    runSeconds(world, 10.0);
    EXPECT_NEAR(see(world, "box").x.x(), -0.04, 0.001);
  });
}

// A wall stops a box that the belt drives: it presses with the friction of its weight, 0.6 m g.
TEST(Belt, PressesAgainstAWall) {
  inEachModeAndStep([](Mode mode, double h) {
    World world = worldOf(kBelt + boxAt("box", 0, 0.25, "mass = 2") +
                              "[[body]]\nname = \"wall\"\nmotion = \"pinned\"\nat = [1, 0.5]\n"
                              "box = [1, 0.8]\nfriction = 0\n",
                          mode, h);
    runSeconds(world, 5.0);
    EXPECT_NEAR(see(world, "box").x.x(), 0.25, 0.005);
    EXPECT_NEAR(see(world, "box").v.norm(), 0.0, 1e-4);
    if (see(world, "box").asleep) return;  // and tells nothing of its contacts any more
    double pressing = 0.0;
    for (const ContactView& c : world.capture().contacts) {
      if (std::abs(c.normal.x()) > 0.9) pressing += c.lambda_n / h;
    }
    EXPECT_NEAR(pressing, 0.6 * 2 * kGravity, 0.2);
  });
}

// Half on firm ground and half on a belt that hardly holds it: the ground does, however the weight
// is shared among four points.
TEST(Belt, WhatStandsHalfOnFirmGroundStays) {
  inEachModeAndStep([](Mode mode, double h) {
    World world = worldOf(
        "[[body]]\nname = \"belt\"\nmotion = \"pinned\"\nat = [5.005, -0.5]\n"
        "box = [10, 1]\nfriction = 0.02\nsurface_velocity = 1\n"
        "[[body]]\nname = \"ground\"\nmotion = \"pinned\"\nat = [-5, -0.5]\n"
        "box = [10, 1]\n[[body]]\nname = \"plank\"\nat = [0, 0.1]\n"
        "box = [4, 0.2]\n",
        mode, h);
    runSeconds(world, 5.0);
    EXPECT_NEAR(see(world, "plank").x.x(), 0.0, 0.01);
  });
}

}  // namespace
}  // namespace merge2d
