/// Joints that merge their bodies.

#include <fmt/format.h>

#include <numbers>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

/// Two bars that rest on the ground end to end, joined as told.
std::string bars(const std::string& joint) {
  return kGround + R"(
[[body]]
name = "a"
at = [0, 0.25]
box = [2, 0.5]
[[body]]
name = "b"
at = [2, 0.25]
box = [2, 0.5]
[[joint]]
at = [1, 0.25]
bodies = ["a", "b"]
)" + joint;
}

/// The same far from any ground.
std::string flying(const std::string& joint) {
  return R"(
format = 1
gravity = [0, 0]
[[body]]
name = "a"
at = [0, 0]
box = [2, 0.5]
velocity = [1, 0]
[[body]]
name = "b"
at = [2, 0]
box = [2, 0.5]
velocity = [1, 0]
[[joint]]
at = [1, 0]
bodies = ["a", "b"]
)" + joint;
}

TEST(JointMerge, AWeldAloneSuffices) {
  Simulation run(flying("kind = \"weld\""), Mode::Merge);
  run.steps(10);
  EXPECT_TRUE(run.merged("a"));
  EXPECT_EQ(run.collectionOf("a"), run.collectionOf("b"));
  EXPECT_TRUE(run.now().joints[0].internal);
}

TEST(JointMerge, ARevoluteJointAloneIsAPivot) {
  Simulation run(flying("kind = \"revolute\""), Mode::Merge);
  run.steps(100);
  EXPECT_FALSE(run.merged("a"));
}

TEST(JointMerge, ARevoluteJointAndAContactAreRigid) {
  // A ramp that hangs in a hinge on a kerb and rests with its other end's corner on the ground.
  Simulation run(R"(
format = 1
[[body]]
name = "ground"
motion = "pinned"
shapes = [{ box = [40, 1], at = [0, -0.5] }, { box = [1, 1], at = [-2.5, 0.5] }]
[[body]]
name = "ramp"
at = [-1, 0.52]
angle = -26.565
box = [2.2, 0.06]
[[joint]]
kind = "revolute"
bodies = ["ground", "ramp"]
at = [-1.98, 1.01]
collide = true
)",
                 Mode::Merge);
  run.until(2.0);
  EXPECT_TRUE(run.merged("ramp"));
  EXPECT_TRUE(run.now().joints[0].internal);
}

TEST(JointMerge, ALimitThatPressesHolds) {
  Simulation run(R"(
format = 1
[[body]]
name = "wall"
motion = "pinned"
at = [0, 0]
box = [1, 1]
[[body]]
name = "shelf"
at = [1.5, 0]
box = [2, 0.1]
[[joint]]
kind = "revolute"
bodies = ["wall", "shelf"]
at = [0.5, 0]
limits = [0, 80]
)",
                 Mode::Merge);
  run.until(2.0);
  EXPECT_TRUE(run.merged("shelf"));
  EXPECT_NEAR(run.now().joints[0].torque, 0.2 * kGravity, 1e-3);
  // A kick from below opens it, and it falls back.
  run.kick("shelf", {0, 1.0});
  run.steps(5);
  EXPECT_FALSE(run.merged("shelf"));
  EXPECT_GT(run.body("shelf").omega, 0.5);
  run.until(6.0);
  EXPECT_TRUE(run.merged("shelf"));
  EXPECT_NEAR(run.body("shelf").angle, 0.0, 0.01);
}

/// A motor turns two bars against each other until a limit stops them, past which they have gone by
/// then.
TEST(JointMerge, BarsMergeWhereTheLimitStands) {
  constexpr double kLimit = (-60.0 + 25.0) * std::numbers::pi / 180.0;
  for (const double speed : {90.0, 200.0, 400.0}) {
    for (const double h : {1.0 / 60.0, 1.0 / 100.0, 1.0 / 240.0}) {
      Simulation run(fmt::format(R"(
format = 1
step = {}
gravity = [0, 0]
[[body]]
name = "a"
box = [1, 0.06]
angle = 30
[[body]]
name = "b"
box = [1, 0.06]
angle = -30
[[joint]]
kind = "revolute"
bodies = ["a", "b"]
at = [0, 0]
limits = [-60, 25]
motor = {{ speed = {}, torque = 1000 }}
)",
                                 h, speed),
                     Mode::Merge);
      run.until(2.0);
      EXPECT_TRUE(run.merged("b")) << speed << " at " << h;
      const double turned = run.body("b").angle - run.body("a").angle;
      EXPECT_NEAR(turned, kLimit, 3e-4) << speed << " at " << h;
    }
  }
}

TEST(JointMerge, ABrakeHoldsUpToItsTorque) {
  const auto arm = [](double torque) {
    return fmt::format(R"(
format = 1
[[body]]
name = "wall"
motion = "pinned"
at = [0, 0]
box = [1, 1]
[[body]]
name = "arm"
at = [1.5, 0]
box = [2, 0.1]
[[joint]]
kind = "revolute"
bodies = ["wall", "arm"]
at = [0.5, 0]
motor = {{ speed = 0, torque = {} }}
)",
                       torque);
  };
  // It bears m g l = 0.2 · 9.81 · 1 N m.
  Simulation strong(arm(2.5), Mode::Merge), weak(arm(1.5), Mode::Merge);
  strong.until(1.0);
  weak.until(1.0);
  EXPECT_TRUE(strong.merged("arm"));
  EXPECT_FALSE(weak.merged("arm"));
  EXPECT_LT(weak.body("arm").angle, -0.1);
}

TEST(JointMerge, ATriangleOfBarsIsRigidAndAFourBarLinkageIsNot) {
  const auto ring = [](int n) {
    std::string scene = "format = 1\ngravity = [0, 0]\n";
    const double turn = 2 * std::numbers::pi / n, r = 0.5 / std::sin(0.5 * turn);
    for (int i = 0; i < n; ++i) {
      const double middle = (i + 0.5) * turn, reach = r * std::cos(0.5 * turn);
      scene += fmt::format(
          "[[body]]\nname = \"bar{}\"\nat = [{}, {}]\nangle = {}\nbox = [1, 0.1]\n"
          "velocity = [0.5, 0]\n",
          i, reach * std::cos(middle), reach * std::sin(middle), middle / kDegree + 90);
    }
    for (int i = 0; i < n; ++i) {
      scene += fmt::format(
          "[[joint]]\nkind = \"revolute\"\nbodies = [\"bar{}\", \"bar{}\"]\nat = [{}, {}]\n",
          (i + n - 1) % n, i, r * std::cos(i * turn), r * std::sin(i * turn));
    }
    return scene;
  };
  Simulation three(ring(3), Mode::Merge), four(ring(4), Mode::Merge);
  three.steps(20);
  four.steps(20);
  EXPECT_TRUE(three.merged("bar0"));
  EXPECT_EQ(three.collectionOf("bar0"), three.collectionOf("bar2"));
  EXPECT_FALSE(four.merged("bar0"));
}

TEST(JointMerge, WhenItsWeldsAreCutTheJointRemains) {
  // Two bars on the ground, pinned end to end, all merged with the ground; a kick lifts one.
  Simulation run(bars("kind = \"revolute\""), Mode::Merge);
  run.until(1.0);
  EXPECT_TRUE(run.merged("a"));
  EXPECT_TRUE(run.merged("b"));
  run.kick("b", {0, 1.2}, {0.9, 0});
  run.steps(5);
  EXPECT_FALSE(run.merged("b"));
  EXPECT_GT(run.body("b").omega, 0.5);
  const JointView joint = run.now().joints[0];
  EXPECT_FALSE(joint.broken);
  EXPECT_NEAR((joint.to - joint.from).norm(), 0.0, 5e-3);
  run.until(6.0);
  EXPECT_NEAR(run.body("b").x.y(), 0.25, 1e-3);  // fell back beside the other
}

TEST(JointMerge, JoinedBodiesSleepTogether) {
  Simulation run(bars("kind = \"weld\""), Mode::MergeSleep);
  run.until(3.0);
  EXPECT_TRUE(run.body("a").asleep);
  EXPECT_TRUE(run.body("b").asleep);
  run.kick("b", {1.5, 0});
  run.steps(2);
  EXPECT_FALSE(run.body("a").asleep);
}

}  // namespace
}  // namespace merge2d
