/// From grains of 0.1 mm to blocks of 100 m: bodies at rest stay at their places.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "src2d/dynamics/solver.h"
#include "src2d/scene/compliance.h"
#include "tests/support/modes_and_steps.h"

namespace merge2d {
namespace {

constexpr int kStack = 10;

/// Ten plates of this thickness on each other, `width` times as wide.
std::string stackOf(double size, double width) {
  std::string toml = fmt::format(
      "[[body]]\nname = \"ground\"\nmotion = \"pinned\"\nat = [0, {}]\n"
      "box = [{}, {}]\n",
      -10 * size, 100 * size * width, 20 * size);
  for (int i = 0; i < kStack; ++i) {
    toml += fmt::format("[[body]]\nname = \"plate{}\"\nat = [0, {}]\nbox = [{}, {}]\n", i,
                        (i + 0.5) * size, width * size, size);
  }
  return toml;
}

// Not even the uppermost sinks by more than 5 % of the size, unless that is less than the fall in a
// step: then ten sweeps do not find the forces before plates have passed through each other.
TEST(Sizes, StacksOfAnySizeStandAsHighAsTheyAre) {
  for (const double size : {1e-4, 5e-4, 5e-3, 0.02, 0.1, 1.0, 100.0}) {
    for (const double width : {1.0, 4.0}) {
      SCOPED_TRACE(fmt::format("{} m, {} times as wide", size, width));
      inEachModeAndStep([&](Mode mode, double h) {
        if (size < kGravity * h * h) return;  // `validate` warns of these
        World world = worldOf(stackOf(size, width), mode, h);
        runSeconds(world, 3.0);
        const BodyState top = see(world, fmt::format("plate{}", kStack - 1));
        EXPECT_NEAR(top.x.y(), (kStack - 0.5) * size, 0.05 * size);
        EXPECT_NEAR(top.x.x(), 0.0, 0.05 * size);
        EXPECT_LT(top.v.norm(), 0.01 * size);  // per second
      });
    }
  }
}

// Grains of 0.1 mm and plates of 0.5 mm, at steps in which they fall by nine tenths of their size
// and by less.
TEST(Sizes, TheSmallestStandAtStepsThatAreShortEnough) {
  for (const double size : {1e-4, 5e-4}) {
    for (const double part : {0.9, 0.3, 0.05}) {
      for (const Mode mode : kAllModes) {
        const double h = std::sqrt(part * size / kGravity);
        SCOPED_TRACE(fmt::format("{} m, {} s, {}", size, h, nameOf(mode)));
        World world = worldOf(stackOf(size, 4.0), mode, h);
        runSeconds(world, 3.0);
        const BodyState top = see(world, fmt::format("plate{}", kStack - 1));
        EXPECT_NEAR(top.x.y(), (kStack - 0.5) * size, 0.05 * size);
        EXPECT_NEAR(top.x.x(), 0.0, 0.05 * size);
      }
    }
  }
}

TEST(Sizes, DiscsOfAnySizeRestToo) {
  for (const double radius : {1e-4, 1e-3, 1e-2, 1.0, 50.0}) {
    SCOPED_TRACE(radius);
    inEachModeAndStep([&](Mode mode, double h) {
      World world = worldOf(fmt::format("[[body]]\nmotion = \"pinned\"\nat = [0, {}]\n"
                                        "box = [{}, {}]\n[[body]]\nname = \"disc\"\nat = [0, {}]\n"
                                        "circle = {}\n",
                                        -10 * radius, 100 * radius, 20 * radius, radius, radius),
                            mode, h);
      runSeconds(world, 3.0);
      EXPECT_NEAR(see(world, "disc").x.y(), radius, 0.05 * 2 * radius);
    });
  }
}

// A column of usual bricks is as it was: the thresholds are those of the settings.
TEST(Sizes, OnlySmallOnesAreHarder) {
  World world = reference(column(1));
  runSeconds(world, 5.0);
  // A weight on two points yields by compliance g h² / (2 erp).
  const SolverSettings& s = world.settings().solver;
  EXPECT_NEAR(0.5 - see(world, BodyId{1}).x.y(), s.compliance * kGravity * 1e-4 / (2.0 * s.erp),
              1e-6);
}

/// Both contacts of a roller yield by C (1/m₁ + 1/m₂) W h² / erp, with the compliance C that the
/// size of the smaller body allows. docs/limits.md has the figures.
TEST(Sizes, AHeavyPlankSinksIntoLightRollersByTheSoftnessOfTheirContacts) {
  constexpr int kRollers = 9;
  for (const double mass : {10.0, 100.0, 1000.0}) {
    SCOPED_TRACE(mass);
    const std::string toml = fmt::format(R"(
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [60, 1]
[[body]]
name = "roller"
at = [-2, 0.1]
circle = 0.1
mass = 1
repeat = {{ count = [{}, 1], spacing = [0.5, 1] }}
[[body]]
name = "plank"
at = [0, 0.25]
box = [4.4, 0.1]
mass = {}
)",
                                         kRollers, mass);
    inEachModeAndStep([&](Mode mode, double h) {
      World world = worldOf(toml, mode, h);
      runSeconds(world, 4.0);
      const SolverSettings& s = world.scene().settings.solver;
      const double fall = kGravity * h * h, weights = mass / kRollers;
      const double at_plank = complianceFor(s, 0.1, fall) * (1.0 + 1.0 / mass) * weights;
      const double at_ground = complianceFor(s, 0.2, fall) * (1.0 + weights);
      const double sinks = (at_plank + at_ground) * fall / s.erp;
      EXPECT_NEAR(0.25 - see(world, "plank").x.y(), sinks, 0.03 * sinks + 1e-6);
    });
  }
}

}  // namespace
}  // namespace merge2d
