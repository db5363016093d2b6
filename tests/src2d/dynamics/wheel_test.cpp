/// Bodies that roll on revolute joints.

#include <gtest/gtest.h>

#include "tests/src2d/dynamics/joint_testing.h"

namespace merge2d {
namespace {

TEST(Joint, AWheelRollsDownASlope) {
  // A disc that rolls without slip accelerates with 2/3 g sin α.
  const double slope = 10 * kDegree;
  World world = running(R"(
gravity = [1.70348, -9.66096]
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [400, 1]
[[body]]
name = "disc"
at = [0, 0.5]
circle = 0.5
)");
  run(world, 2.0);
  const BodyState disc = body(world, "disc");
  EXPECT_NEAR(disc.v.x(), 2.0 / 3.0 * kGravity * std::sin(slope) * 2.0, 0.02);
  EXPECT_NEAR(disc.omega, -disc.v.x() / 0.5, 0.02);
}

TEST(Joint, ACartRollsOnItsWheels) {
  // (M + 2m + 2I/r²) a = (M + 2m) g sin α, with I = m r² / 2 of each wheel.
  const double slope = 10 * kDegree, cart = 4.0, wheel = 0.5;
  World world = running(R"(
gravity = [1.70348, -9.66096]
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [400, 1]
[[body]]
name = "cart"
at = [0, 0.6]
box = [2, 0.4]
mass = 4
[[body]]
name = "wheel"
at = [-0.7, 0.3]
circle = 0.3
mass = 0.5
repeat = { count = [2, 1], spacing = [1.4, 0] }
[[joint]]
kind = "revolute"
bodies = ["cart", "wheel[0,0]"]
at = [-0.7, 0.3]
[[joint]]
kind = "revolute"
bodies = ["cart", "wheel[1,0]"]
at = [0.7, 0.3]
)");
  run(world, 2.0);
  const double expected =
      (cart + 2 * wheel) / (cart + 3 * wheel) * kGravity * std::sin(slope) * 2.0;
  EXPECT_NEAR(body(world, "cart").v.x(), expected, 0.02 * expected);
  EXPECT_NEAR(body(world, "wheel[0,0]").omega, -body(world, "cart").v.x() / 0.3, 0.05);
}

}  // namespace
}  // namespace merge2d
