/// Forces of joints inside collections and between them.

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

TEST(JointLoad, ACantileverBearsItsMoment) {
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
repeat = { count = [3, 1], spacing = [1, 1] }
[[joint]]
kind = "weld"
bodies = ["wall", "beam[0,0]"]
at = [0, 0]
[[joint]]
kind = "weld"
bodies = ["beam[0,0]", "beam[1,0]"]
at = [1, 0]
[[joint]]
kind = "weld"
bodies = ["beam[1,0]", "beam[2,0]"]
at = [2, 0]
)",
                 Mode::Merge);
  run.until(4.0);
  ASSERT_TRUE(run.merged("beam[2,0]"));
  const Snapshot now = run.now();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto beyond = static_cast<double>(3 - i);
    EXPECT_TRUE(now.joints[i].internal);
    EXPECT_NEAR(now.joints[i].force.y(), 2 * kGravity * beyond, 0.01);
    EXPECT_NEAR(now.joints[i].torque, 2 * kGravity * beyond * 0.5 * beyond, 0.05);
  }
}

TEST(JointLoad, AWeldHoldsASpinningArmOnItsCircle) {
  Simulation run(R"(
format = 1
gravity = [0, 0]
[[body]]
name = "hub"
at = [0, 0]
circle = 0.5
mass = 1000
spin = 30
[[body]]
name = "arm"
at = [1, 0]
box = [2, 0.1]
velocity = [0, 0.523598776]
spin = 30
[[joint]]
kind = "weld"
bodies = ["hub", "arm"]
at = [0, 0]
)",
                 Mode::Merge);
  run.until(2.0);
  ASSERT_TRUE(run.merged("arm"));
  const Pose before = seenFrom(run.body("hub"), run.body("arm"));
  run.until(30.0);
  EXPECT_EQ(run.count(EventType::Unmerge), 0);
  const Pose after = seenFrom(run.body("hub"), run.body("arm"));
  EXPECT_NEAR((after.position - before.position).norm(), 0.0, 1e-9);
  const double omega = run.body("arm").omega, expected = 0.2 * omega * omega;  // m ω² r
  EXPECT_NEAR(run.now().joints[0].force.norm(), expected, 0.01 * expected);
}

TEST(JointLoad, ACollectionHoldsAnotherByAPivotBetweenThem) {
  // Each bar carries a box that merges with it; the pivot stays outside.
  Simulation run(R"(
format = 1
[[body]]
name = "hook"
motion = "pinned"
at = [0, 0]
box = [0.2, 0.2]
[[body]]
name = "tray"
at = [0, -2]
shapes = [{ box = [0.1, 2], at = [0, 1] }, { box = [2, 0.2] }]
[[body]]
name = "crate"
at = [0.3, -1.65]
box = [0.5, 0.5]
[[joint]]
kind = "revolute"
bodies = ["hook", "tray"]
at = [0, 0]
)",
                 Mode::Merge);
  run.until(10.0);
  EXPECT_TRUE(run.merged("crate"));
  EXPECT_EQ(run.collectionOf("crate"), run.collectionOf("tray"));
  const Snapshot now = run.now();
  EXPECT_FALSE(now.joints[0].internal);
  EXPECT_NEAR((now.joints[0].to - now.joints[0].from).norm(), 0.0, 2e-3);
}

}  // namespace
}  // namespace merge2d
