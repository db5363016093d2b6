/// Forces of joints inside collections and between them.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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

/// A load of 50 kg on a hoist that goes up and down by a metre in `period`.
std::string hoist(double period, const std::string& joint, const std::string& rule = "default") {
  return fmt::format(R"(
format = 1
[merging]
rule = "{0}"
[unmerging]
rule = "{0}"
[[body]]
name = "hoist"
motion = "scripted"
at = [0, 0]
box = [1, 0.2]
script = {{ axis = [0, 1], amplitude = 0.5, period = {1} }}
[[body]]
name = "load"
at = [0, -0.5]
box = [0.6, 0.6]
mass = 50
[[joint]]
at = [0, -0.1]
bodies = ["hoist", "load"]
{2})",
                     rule, period, joint);
}

/// The largest error of the stretch of that joint against compliance · m (g + a), from 1 s on [m].
double errorOfStretch(Simulation& run, double period, double compliance) {
  const double omega = 2 * std::numbers::pi / period;
  double worst = 0.0;
  run.until(1.0);
  for (int step = 0; step < 700; ++step) {
    run.steps(1);
    const double t = run.now().time, a = 0.5 * omega * omega * std::cos(omega * t);
    const double stretch = run.body("hoist").x.y() - 0.5 - run.body("load").x.y();
    worst = std::max(worst, std::abs(stretch - compliance * 50 * (kGravity + a)));
  }
  return worst;
}

/// Inside a collection too a soft joint gives way with its load, by up to 15 mm here. As elsewhere
/// an imbalance stays that would part the bodies more slowly than welds are cut: a twentieth of g.
TEST(JointLoad, ASoftWeldStretchesWithItsLoad) {
  constexpr double kCompliance = 2e-5;
  for (const Mode mode : {Mode::Reference, Mode::Merge, Mode::MergeSleep}) {
    for (const double period : {2.0, 4.0, 20.0}) {
      SCOPED_TRACE(fmt::format("{}, {} s", name(mode), period));
      Simulation run(hoist(period, "kind = \"weld\"\ncompliance = 2e-5\n"), mode);
      EXPECT_LT(errorOfStretch(run, period, kCompliance), 0.06 * kCompliance * 50 * kGravity);
    }
  }
}

TEST(JointLoad, ASoftLimitGivesWayToItsLoad) {
  constexpr double kCompliance = 2e-5;
  const std::string slider =
      "kind = \"prismatic\"\naxis = [0, 1]\nlimits = [0, 1]\ncompliance = 2e-5\n";
  for (const Mode mode : {Mode::Reference, Mode::Merge}) {
    SCOPED_TRACE(name(mode));
    Simulation run(hoist(20.0, slider), mode);
    EXPECT_LT(errorOfStretch(run, 20.0, kCompliance), 0.06 * kCompliance * 50 * kGravity);
    EXPECT_EQ(run.count(EventType::Merge) > 0, mode == Mode::Merge);
  }
}

TEST(JointLoad, UnderThePapersRuleASoftWeldStretchesToo) {
  constexpr double kCompliance = 2e-5;
  Simulation run(hoist(20.0, "kind = \"weld\"\ncompliance = 2e-5\n", "paper"), Mode::Merge);
  EXPECT_LT(errorOfStretch(run, 20.0, kCompliance), 0.06 * kCompliance * 50 * kGravity);
  EXPECT_GT(run.count(EventType::Merge), 0);
}

/// A soft limit that a body runs into gives way by v √(C m), and gives the speed back but for the
/// damping of the implicit step.
TEST(JointLoad, ASoftLimitIsASpringFromTheFirstTouchOn) {
  for (const double speed : {0.95, 1.0, 1.1, 1.2}) {
    Simulation run(fmt::format(R"(
format = 1
gravity = [0, 0]
[[body]]
name = "slider"
at = [0, 0]
box = [0.5, 0.5]
mass = 20
velocity = [{}, 0]
[[joint]]
kind = "prismatic"
bodies = ["slider"]
at = [0, 0]
axis = [1, 0]
limits = [-9, 1]
compliance = 1e-3
)",
                               speed),
                   Mode::Reference);
    double farthest = 0.0;
    run.steps(300, [&] { farthest = std::max(farthest, run.body("slider").x.x()); });
    const double overrun = speed * std::sqrt(1e-3 * 20.0);
    EXPECT_NEAR(farthest - 1.0, overrun, 0.15 * overrun) << speed;
    EXPECT_NEAR(run.body("slider").v.x(), -0.9 * speed, 0.12 * speed) << speed;
  }
}

/// A plank of 5 kg and 2 m on a soft joint, and boxes of 1 kg that come to lie on it at 1.5 m.
std::string plankUnderBoxes(const std::string& joint) {
  return R"(
format = 1
[[body]]
name = "wall"
motion = "pinned"
at = [-0.5, 0]
box = [1, 0.8]
[[body]]
name = "plank"
at = [1, 0]
box = [2, 0.2]
mass = 5
[[body]]
name = "box"
at = [1.5, 0.35]
box = [0.5, 0.5]
mass = 1
pinned_until = 2
[[body]]
name = "late"
at = [1.5, 0.9]
box = [0.5, 0.5]
mass = 1
pinned_until = 4
[[joint]]
at = [0, 0]
bodies = ["wall", "plank"]
compliance = 2e-4
)" + joint;
}

TEST(JointLoad, ASoftPlankBendsUnderThoseThatComeToLieOnIt) {
  for (const std::string joint : {"kind = \"weld\"", "kind = \"revolute\"\nlimits = [0, 10]"}) {
    for (const Mode mode : {Mode::Reference, Mode::Merge, Mode::MergeSleep}) {
      SCOPED_TRACE(name(mode) + (" " + joint));
      Simulation run(plankUnderBoxes(joint), mode);
      for (const auto& [time, boxes] : {std::pair(1.9, 0.0), {3.9, 1.0}, {8.0, 2.0}}) {
        run.until(time);
        const double turn = 2e-4 * kGravity * (5 * 1.0 + boxes * 1.5);
        EXPECT_NEAR(run.body("plank").angle, -turn, 0.06 * turn) << boxes;
      }
      EXPECT_EQ(run.merged("late"), mode != Mode::Reference);
    }
  }
}

}  // namespace
}  // namespace merge2d
