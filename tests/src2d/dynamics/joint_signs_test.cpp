/// Positive is counter-clockwise and along the axis, for the body that is named.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "src2d/dynamics/joint.h"
#include "tests/support/modes_and_steps.h"

namespace merge2d {
namespace {

/// A wheel and a slider without gravity; `bodies` are put in front of "wheel" and "slider".
std::string driven(const std::string& bodies, const std::string& wheel, const std::string& slider) {
  return fmt::format(R"(
gravity = [0, 0]
[[body]]
name = "base"
motion = "pinned"
at = [0, -5]
box = [1, 1]
[[body]]
name = "wheel"
box = [1, 0.1]
[[body]]
name = "slider"
at = [3, 0]
angle = 90
box = [1, 0.1]
[[joint]]
kind = "revolute"
bodies = [{0}"wheel"]
at = [0, 0]
{1}
[[joint]]
kind = "prismatic"
bodies = [{0}"slider"]
at = [3, 0]
axis = [0, 2]
{2}
)",
                     bodies, wheel, slider);
}

// A motor of ample strength has its speed after one step; the tolerance is that of rounding.
TEST(JointSigns, APositiveMotorTurnsCounterClockwiseAndDrivesAlongTheAxis) {
  for (const char* bodies : {"", "\"base\", "}) {
    inEachModeAndStep([&](Mode mode, double h) {
      World world = worldOf(driven(bodies, "motor = { speed = 30, torque = 100 }",
                                   "motor = { speed = 0.5, force = 100 }"),
                            mode, h);
      runSeconds(world, 1.0);
      EXPECT_NEAR(see(world, "wheel").angle, 30 * kDegree, 1e-6);
      EXPECT_NEAR(see(world, "slider").x.y(), 0.5, 1e-6);
    });
  }
}

// A motor presses against a limit of the same sign; the tolerance is that of its
// first touch.
TEST(JointSigns, LimitsAreAnglesAndWaysOfTheBody) {
  const auto limited = [](double direction) {
    return std::pair(
        fmt::format("motor = {{ speed = {}, torque = 1 }}\nlimits = [-10, 40]", 60 * direction),
        fmt::format("motor = {{ speed = {}, force = 1 }}\nlimits = [-0.1, 0.4]", direction));
  };
  for (const char* bodies : {"", "\"base\", "}) {
    inEachModeAndStep([&](Mode mode, double h) {
      const auto [forth, up] = limited(1.0);
      World ahead = worldOf(driven(bodies, forth, up), mode, h);
      runSeconds(ahead, 2.0);
      EXPECT_NEAR(see(ahead, "wheel").angle, 40 * kDegree, 0.1 * kDegree);
      EXPECT_NEAR(see(ahead, "slider").x.y(), 0.4, 0.005);
      const auto [back, down] = limited(-1.0);
      World behind = worldOf(driven(bodies, back, down), mode, h);
      runSeconds(behind, 2.0);
      EXPECT_NEAR(see(behind, "wheel").angle, -10 * kDegree, 0.1 * kDegree);
      EXPECT_NEAR(see(behind, "slider").x.y(), -0.1, 0.005);
    });
  }
}

// A soft limit yields by a few millimetres.
TEST(JointSigns, ADistanceIsTheSameFromBothEnds) {
  const std::string bob = R"(
[[body]]
name = "hook"
motion = "pinned"
at = [0, 1]
box = [0.1, 0.1]
[[body]]
name = "bob"
at = [0, -1]
circle = 0.1
[[joint]]
kind = "distance"
limits = [0, 1.5]
)";
  for (const char* ends : {"bodies = [\"bob\"]\nat = [0, -1]\nto = [0, 0]\n",
                           "bodies = [\"bob\", \"hook\"]\nat = [0, -1]\nto = [0, 0]\n",
                           "bodies = [\"hook\", \"bob\"]\nat = [0, 0]\nto = [0, -1]\n"}) {
    SCOPED_TRACE(ends);
    inEachModeAndStep([&](Mode mode, double h) {
      World world = worldOf(bob + ends, mode, h);
      runSeconds(world, 5.0);
      EXPECT_NEAR(see(world, "bob").x.y(), -1.5, 0.01);
    });
  }
}

}  // namespace
}  // namespace merge2d
