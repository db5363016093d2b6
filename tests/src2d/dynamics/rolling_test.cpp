/// Rolling resistance: a torque of at most `rolling` times the normal force.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "src2d/dynamics/contact_block.h"
#include "tests/support/modes_and_steps.h"

namespace merge2d {
namespace {

/// A disc of radius 0.5 m that rolls at 2 m/s on a level floor.
std::string rollingDisc(const std::string& of_disc, const std::string& of_floor) {
  return fmt::format(R"(
[[body]]
name = "floor"
motion = "pinned"
at = [0, -0.5]
box = [200, 1]
{}
[[body]]
name = "disc"
at = [0, 0.5]
circle = 0.5
velocity = [2, 0]
spin = {}
{}
)",
                     of_floor, -4.0 / kDegree, of_disc);
}

// m a = F, (m r²/2) α = ρ N − F r: a = 2/3 ρ g / r. The tolerance is a step at the first speed.
TEST(Rolling, ADiscOnALevelFloorComesToRestWhereItsResistanceSays) {
  inEachModeAndStep([](Mode mode, double h) {
    const double rolling = 0.05, a = 2.0 / 3.0 * rolling * kGravity / 0.5;
    World world = worldOf(rollingDisc("rolling = 0.05", ""), mode, h);
    runSeconds(world, 1.0);
    EXPECT_NEAR(see(world, "disc").v.x(), 2.0 - a, 0.01);
    runSeconds(world, 4.0);
    EXPECT_NEAR(see(world, "disc").x.x(), 2.0 / a, 2.0 * h);
    EXPECT_NEAR(see(world, "disc").omega, 0.0, 1e-6);
  });
}

TEST(Rolling, TheLargerOfTwoCounts) {
  for (const char* of_floor : {"", "rolling = 0.02"}) {
    inEachModeAndStep([&](Mode mode, double h) {
      World world = worldOf(rollingDisc("rolling = 0.05", of_floor), mode, h);
      World other = worldOf(rollingDisc(of_floor, "rolling = 0.05"), mode, h);
      runSeconds(world, 1.0);
      runSeconds(other, 1.0);
      EXPECT_EQ(see(world, "disc").v.x(), see(other, "disc").v.x());
    });
  }
}

TEST(Rolling, WithoutItADiscRollsOn) {
  inEachModeAndStep([](Mode mode, double h) {
    World world = worldOf(rollingDisc("", ""), mode, h);
    runSeconds(world, 5.0);
    EXPECT_NEAR(see(world, "disc").v.x(), 2.0, 1e-3);
  });
}

// On a slope a disc stays while tan(slope) < rolling / r.
TEST(Rolling, HoldsADiscOnASlopeUpToItsAngle) {
  const auto movedOn = [](double slope, Mode mode, double h) {
    World world = worldOf(fmt::format("gravity = [{}, {}]\n[[body]]\nmotion = \"pinned\"\n"
                                      "at = [0, -0.5]\nbox = [40, 1]\n[[body]]\nname = \"disc\"\n"
                                      "at = [0, 0.5]\ncircle = 0.5\nrolling = 0.05\n",
                                      kGravity * std::sin(slope), -kGravity * std::cos(slope)),
                          mode, h);
    runSeconds(world, 5.0);
    return see(world, "disc").x.x();
  };
  inEachModeAndStep([&](Mode mode, double h) {
    EXPECT_NEAR(movedOn(std::atan(0.095), mode, h), 0.0, 1e-3);
    // Beyond it: a = 2/3 (g sin − ρ g cos / r).
    const double slope = std::atan(0.2);
    const double a = 2.0 / 3.0 * kGravity * (std::sin(slope) - 0.1 * std::cos(slope));
    EXPECT_NEAR(movedOn(slope, mode, h), 12.5 * a, 0.02 * 12.5 * a);  // a softly held contact
  });
}

TEST(Rolling, DiscsOnAHeapComeToRest) {
  inEachModeAndStep([](Mode mode, double h) {
    World world = worldOf(R"(
[material]
rolling = 0.02
[[body]]
motion = "pinned"
at = [0, -0.5]
box = [40, 1]
[[body]]
name = "disc"
at = [0, 0.3]
circle = 0.25
repeat = { count = [4, 6], spacing = [0.51, 0.52], stagger = 0.5 }
)",
                          mode, h);
    runSeconds(world, 20.0);
    EXPECT_LT(fastest(world), 1e-3);
  });
}

}  // namespace
}  // namespace merge2d
