/// Joints against closed forms, without merging.

#include "src2d/dynamics/joint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/src2d/dynamics/joint_testing.h"

namespace merge2d {
namespace {

const std::string kPendulum = R"(
step = 0.001
[[body]]
name = "bob"
at = [0.1, -1]
circle = 0.1
mass = 2
[[joint]]
kind = "revolute"
bodies = ["bob"]
at = [0, 0]
)";

TEST(Joint, APendulumSwingsWithItsPeriod) {
  World world = running(kPendulum);
  // A compound pendulum: T = 2π √(I / (m g l)), I about the pivot; small amplitude.
  const double l = std::hypot(0.1, 1.0), inertia = 0.5 * 0.1 * 0.1 + l * l;
  const double quarter = 0.5 * std::numbers::pi * std::sqrt(inertia / (kGravity * l));
  while (body(world, "bob").x.x() > 0.0) world.step();
  EXPECT_NEAR(world.time(), quarter, 0.01 * quarter);
}

TEST(Joint, APendulumStaysAtItsDistance) {
  World world = running(kPendulum);
  for (int i = 0; i < 3000; ++i) {
    world.step();
    ASSERT_NEAR(body(world, "bob").x.norm(), std::hypot(0.1, 1.0), 1e-3);
  }
}

TEST(Joint, ARopeBearsTheWeightOfAllItsLinks) {
  World world = running(R"(
[[body]]
name = "hook"
motion = "pinned"
at = [0, 0]
box = [0.2, 0.2]
[[body]]
name = "link"
at = [0, -0.5]
box = [0.1, 1]
mass = 1.5
repeat = { count = [1, 4], spacing = [1, -1] }
[[joint]]
kind = "revolute"
bodies = ["hook", "link[0,0]"]
at = [0, 0]
[[joint]]
kind = "revolute"
bodies = ["link[0,0]", "link[0,1]"]
at = [0, -1]
[[joint]]
kind = "revolute"
bodies = ["link[0,1]", "link[0,2]"]
at = [0, -2]
[[joint]]
kind = "revolute"
bodies = ["link[0,2]", "link[0,3]"]
at = [0, -3]
)");
  run(world, 5.0);
  const Snapshot now = world.capture();
  ASSERT_EQ(now.joints.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(now.joints[i].force.norm(), (4.0 - static_cast<double>(i)) * 1.5 * kGravity, 0.05);
  }
}

TEST(Joint, AWeldedBeamBearsItsMoment) {
  World world = running(R"(
[[body]]
name = "wall"
motion = "pinned"
at = [-0.5, 0]
box = [1, 1]
[[body]]
name = "beam"
at = [1, 0]
box = [2, 0.2]
mass = 3
[[joint]]
kind = "weld"
bodies = ["wall", "beam"]
at = [0, 0]
)");
  run(world, 3.0);
  const Snapshot now = world.capture();
  EXPECT_NEAR(now.joints[0].force.y(), 3 * kGravity, 0.05);
  EXPECT_NEAR(now.joints[0].torque, 3 * kGravity * 1.0, 0.05);
  EXPECT_NEAR(body(world, "beam").x.y(), 0.0, 0.01);
}

TEST(Joint, KeepsMomentumAndAngularMomentum) {
  World world = running(R"(
gravity = [0, 0]
[[body]]
name = "a"
at = [0, 0]
box = [1, 0.3]
velocity = [1, -2]
spin = 100
[[body]]
name = "b"
at = [1, 0]
box = [1, 0.3]
mass = 2
velocity = [0, 2]
[[joint]]
kind = "revolute"
bodies = ["a", "b"]
at = [0.5, 0]
)");
  const Stats before = world.capture().stats;
  run(world, 5.0);
  const Stats after = world.capture().stats;
  EXPECT_NEAR((after.momentum - before.momentum).norm(), 0.0, 1e-9);
  // The symplectic step turns momenta about points that have moved on: first order in h.
  EXPECT_NEAR(after.angular_momentum, before.angular_momentum,
              0.02 * std::abs(before.angular_momentum));
}

TEST(Joint, ADistanceJointWithStiffnessIsASpring) {
  World world = running(R"(
step = 0.001
gravity = [0, 0]
[[body]]
name = "bob"
at = [2, 0]
circle = 0.2
mass = 2
velocity = [1, 0]
[[joint]]
kind = "distance"
bodies = ["bob"]
at = [2, 0]
to = [0, 0]
stiffness = 50
)");
  while (body(world, "bob").v.x() > 0.0) world.step();
  EXPECT_NEAR(world.time(), 0.5 * std::numbers::pi * std::sqrt(2.0 / 50.0), 0.005);
  EXPECT_NEAR(body(world, "bob").x.x(), 2.0 + std::sqrt(2.0 / 50.0), 0.005);
}

TEST(Joint, ARopeIsSlackUntilItIsStretched) {
  World world = running(R"(
[[body]]
name = "bob"
at = [0, 0]
circle = 0.2
[[joint]]
kind = "distance"
bodies = ["bob"]
at = [0, 0]
to = [0, 0.5]
limits = [0, 1.5]
)");
  run(world, 0.3);
  EXPECT_NEAR(body(world, "bob").v.y(), -kGravity * 0.3, 1e-6);  // falls freely at first
  run(world, 3.0);
  EXPECT_NEAR(body(world, "bob").x.y(), -1.0, 0.01);
}

TEST(Joint, ASliderFallsAlongItsAxisAlone) {
  World world = running(R"(
[[body]]
name = "cart"
at = [0, 0]
box = [0.4, 0.2]
[[joint]]
kind = "prismatic"
bodies = ["cart"]
at = [0, 0]
axis = [1, -1]
limits = [-5, 5]
)");
  run(world, 0.5);
  const BodyState cart = body(world, "cart");
  const double along = kGravity / std::sqrt(2.0) * 0.5;  // g sin 45° t
  EXPECT_NEAR(cart.v.x(), along / std::sqrt(2.0), 0.05);
  EXPECT_NEAR(cart.v.y(), -along / std::sqrt(2.0), 0.05);
  EXPECT_NEAR(cart.angle, 0.0, 0.01);  // a joint is as soft as a contact
}

/// The rail bears it where it is, not where it was at the start: the weight turned it more and
/// more.
TEST(Joint, ASliderHangsOnItsRailWhereverItIs) {
  World world = running(R"(
[[body]]
name = "cart"
at = [0, 0]
box = [0.4, 0.2]
mass = 20
velocity = [10, 0]
[[joint]]
kind = "prismatic"
bodies = ["cart"]
at = [0, 0]
axis = [1, 0]
compliance = 1e-5
)");
  run(world, 5.0);
  const BodyState cart = body(world, "cart");
  EXPECT_NEAR(cart.x.x(), 50.0, 1e-6);
  EXPECT_NEAR(cart.x.y(), -1e-5 * 20.0 * kGravity, 1e-6);
  EXPECT_NEAR(cart.angle, 0.0, 1e-9);
  const JointView rail = world.capture().joints.front();
  EXPECT_NEAR(rail.force.y(), -20.0 * kGravity, 1e-3);      // on the world
  EXPECT_NEAR(rail.torque, -20.0 * kGravity * 50.0, 1e-2);  // about where the rail begins
}

TEST(Joint, LimitsHold) {
  World world = running(R"(
[[body]]
name = "cart"
at = [0, 0]
box = [0.4, 0.2]
[[joint]]
kind = "prismatic"
bodies = ["cart"]
at = [0, 0]
axis = [0, 1]
limits = [-1, 2]
[[body]]
name = "flap"
at = [3, 0]
box = [2, 0.1]
[[joint]]
kind = "revolute"
bodies = ["flap"]
at = [2, 0]
limits = [-30, 60]
)");
  run(world, 3.0);
  EXPECT_NEAR(body(world, "cart").x.y(), -1.0, 0.01);
  EXPECT_NEAR(body(world, "flap").angle, -30 * kDegree, 0.5 * kDegree);
}

TEST(Joint, AMotorTurnsAtItsSpeed) {
  World world = running(R"(
[[body]]
name = "arm"
at = [1, 0]
box = [2, 0.2]
[[joint]]
kind = "revolute"
bodies = ["arm"]
at = [1, 0]
motor = { speed = 90, torque = 100 }
)");
  run(world, 1.0);
  EXPECT_NEAR(body(world, "arm").omega, 0.5 * std::numbers::pi, 1e-3);
}

TEST(Joint, AMotorIsNoStrongerThanItsTorque) {
  World world = running(R"(
gravity = [0, 0]
[[body]]
name = "arm"
at = [0, 0]
box = [2, 0.2]
mass = 3
[[joint]]
kind = "revolute"
bodies = ["arm"]
at = [0, 0]
motor = { speed = 9000, torque = 2 }
)");
  const double inertia = world.bodies()[0].inertia;
  run(world, 1.0);
  EXPECT_NEAR(body(world, "arm").omega, 2.0 / inertia, 1e-3);
}

TEST(Joint, JoinedBodiesDoNotTouchUnlessTold) {
  const std::string scene = R"(
gravity = [0, 0]
[[body]]
name = "a"
at = [0, 0]
box = [1, 1]
[[body]]
name = "b"
at = [0.9, 0]
box = [1, 1]
[[joint]]
kind = "weld"
bodies = ["a", "b"]
at = [0.45, 0]
)";
  World apart = running(scene), touching = running(scene + "collide = true\n");
  apart.step();
  touching.step();
  EXPECT_TRUE(apart.capture().contacts.empty());
  EXPECT_FALSE(touching.capture().contacts.empty());
}

/// A load of 2 kg on a hook, by a joint that bears `bears` newtons.
std::string loadOnAHook(double bears) {
  return R"(
[[body]]
name = "hook"
motion = "pinned"
at = [0, 0]
box = [0.2, 0.2]
[[body]]
name = "load"
at = [0, -0.1]
circle = 0.1
mass = 2
[[joint]]
kind = "revolute"
bodies = ["hook", "load"]
at = [0, 0]
break_force = )" +
         std::to_string(bears);
}

/// The names of those whose joints broke, and when.
std::vector<std::string> breaksOf(World& world, double time) {
  std::vector<std::string> found;
  while (world.time() < time - 1e-9) {
    world.step();
    for (const Event& e : world.events()) {
      if (e.type != EventType::Break) continue;
      found.push_back(world.bodies()[index(e.a)].name + " " + world.bodies()[index(e.b)].name);
    }
  }
  return found;
}

TEST(Joint, BreaksUnderMoreThanItBears) {
  World weak = running(loadOnAHook(15)), strong = running(loadOnAHook(25));
  run(weak, 1.0);
  run(strong, 1.0);
  EXPECT_TRUE(weak.capture().joints[0].broken);
  EXPECT_LT(body(weak, "load").x.y(), -0.3);
  EXPECT_FALSE(strong.capture().joints[0].broken);
  EXPECT_NEAR(body(strong, "load").x.y(), -0.1, 0.01);
}

TEST(Joint, TellsOnceThatItBroke) {
  for (const Mode mode : {Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
    World weak = running(loadOnAHook(15), mode), strong = running(loadOnAHook(25), mode);
    EXPECT_THAT(breaksOf(weak, 1.0), testing::ElementsAre("hook load")) << name(mode);
    EXPECT_THAT(breaksOf(strong, 1.0), testing::IsEmpty()) << name(mode);
  }
}

TEST(Joint, OfOneBodyAndTheWorldTellsOfThatBodyAlone) {
  World world = running(R"(
[[body]]
name = "lamp"
circle = 0.1
mass = 2
[[joint]]
kind = "revolute"
bodies = ["lamp"]
at = [0, 0]
break_force = 15
)");
  EXPECT_THAT(breaksOf(world, 1.0), testing::ElementsAre("lamp lamp"));
}

TEST(Joint, BodiesTouchAgainWhenTheirJointBreaks) {
  World world = running(R"(
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [10, 1]
[[body]]
name = "crate"
at = [0, 0.4]
box = [1, 1]
[[joint]]
kind = "revolute"
bodies = ["ground", "crate"]
at = [0, 0]
break_force = 5
)");
  run(world, 2.0);
  EXPECT_NEAR(body(world, "crate").x.y(), 0.5, 0.01);  // pushed out of the ground
}

}  // namespace
}  // namespace merge2d
