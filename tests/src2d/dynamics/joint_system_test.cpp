/// The forces of joints inside collections, against statics.

#include <fmt/format.h>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

constexpr double kMass = 0.18;                         // kg, of a plank
constexpr double kWeight = kMass * 9.81, kFrom = 4.0;  // N, s

/// `count` planks in a row, welded to each other and to a wall. From 4 s on a force pulls down the
/// last one.
std::string cantilever(int count, double force, double strength) {
  std::string toml =
      "format = 1\n[[body]]\nname = \"wall\"\nmotion = \"pinned\"\nat = [-0.5, 0]\nbox = [1, 1]\n";
  for (int i = 0; i < count; ++i) {
    toml += fmt::format("[[body]]\nname = \"p{}\"\nat = [{}, 0]\nbox = [0.9, 0.2]\n", i, i + 0.5);
  }
  for (int i = 0; i < count; ++i) {
    const std::string before = i == 0 ? "wall" : fmt::format("p{}", i - 1);
    toml += fmt::format(
        "[[joint]]\nkind = \"weld\"\nbodies = [\"{}\", \"p{}\"]\nat = [{}, 0]\nbreak_torque = {}\n",
        before, i, i, strength);
  }
  return toml + fmt::format("[[force]]\nbody = \"p{}\"\nforce = [0, {}]\nfrom = {}\n", count - 1,
                            -force, kFrom);
}

/// At the wall, of the planks' weight and the force [N m].
double momentAtWall(int count, double force) {
  double moment = force * (count - 0.5);
  for (int i = 0; i < count; ++i) moment += kWeight * (i + 0.5);
  return moment;
}

int breaksIn(Simulation& run, int steps) {
  const int before = run.count(EventType::Break);
  run.steps(steps);
  return run.count(EventType::Break) - before;
}

TEST(JointSystem, ACantileverBreaksWhereStaticsSay) {
  constexpr double kForce = 12.8;
  for (const int count : {3, 5, 7}) {
    const double moment = momentAtWall(count, kForce);
    for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
      Simulation weak(cantilever(count, kForce, moment / 1.05), mode);
      weak.until(kFrom);
      ASSERT_TRUE(weak.merged("p0")) << count;
      ASSERT_EQ(weak.count(EventType::Break), 0) << count;
      EXPECT_GT(breaksIn(weak, 5), 0) << count << " planks bear too much";

      Simulation strong(cantilever(count, kForce, moment / 0.95), mode);
      strong.until(kFrom);
      EXPECT_EQ(breaksIn(strong, 300), 0) << count << " planks bear it";
      EXPECT_TRUE(strong.merged("p0")) << count;
    }
  }
}

/// The moment of a force at the last plank comes to the wall by one joint in a step, or so.
TEST(JointSystem, UnderThePapersRuleACantileverBreaksStepsLater) {
  const auto stepOfBreaking = [](int count, const Overrides& overrides) {
    constexpr double kForce = 12.8;
    Simulation run(cantilever(count, kForce, momentAtWall(count, kForce) / 1.05), Mode::Merge,
                   overrides);
    run.until(kFrom);
    const std::int64_t from = run.world().steps();
    while (run.count(EventType::Break) == 0 && run.world().time() < 10.0) run.steps(1);
    return run.world().steps() - from;
  };
  for (const auto& [count, later] : {std::pair{3, 6}, {5, 8}, {7, 10}}) {
    EXPECT_EQ(stepOfBreaking(count, {}), 1) << count;
    EXPECT_EQ(stepOfBreaking(count, kPaper), later) << count;
  }
}

TEST(JointSystem, ABridgeBreaksUnderAWeightAsInTheReference) {
  std::string toml = kGround;
  for (const double x : {-4.0, 4.0}) {
    toml += fmt::format("[[body]]\nmotion = \"pinned\"\nat = [{}, 1]\nbox = [1, 2]\n", x);
  }
  for (int i = 0; i < 9; ++i) {
    toml += fmt::format("[[body]]\nname = \"plank{}\"\nat = [{}, 2.1]\nbox = [0.98, 0.2]\n", i,
                        i - 4.0);
  }
  for (int i = 0; i < 8; ++i) {
    toml += fmt::format(
        "[[joint]]\nkind = \"weld\"\nbodies = [\"plank{}\", \"plank{}\"]\nat = [{}, 2.1]\n"
        "break_force = 200\nbreak_torque = 120\n",
        i, i + 1, i - 3.5);
  }
  toml +=
      "[[body]]\nname = \"weight\"\nat = [0, 3.5]\nbox = [0.5, 0.5]\nmass = 30\n"
      "pinned_until = 3\n";
  for (const Mode mode : {Mode::Reference, Mode::Merge, Mode::MergeSleep}) {
    Simulation run(toml, mode);
    run.until(3.0);
    EXPECT_EQ(run.count(EventType::Break), 0) << name(mode);
    run.until(5.0);
    EXPECT_GT(run.count(EventType::Break), 0) << name(mode);
    EXPECT_LT(run.body("weight").x.y(), 1.0) << name(mode) << ": it fell through";
  }
}

/// A ring asks for more than there is to know: its forces are still finite, and carry the weight.
TEST(JointSystem, ARingOfWeldsHoldsItsWeight) {
  std::string toml = kGround;
  const Vec2 at[] = {{-0.5, 0.5}, {0.5, 0.5}, {0.5, 1.5}, {-0.5, 1.5}};
  for (int i = 0; i < 4; ++i) {
    toml += fmt::format("[[body]]\nname = \"r{}\"\nat = [{}, {}]\nbox = [0.98, 0.98]\n", i,
                        at[i].x(), at[i].y() + 0.05);
  }
  for (int i = 0; i < 4; ++i) {
    const Vec2 middle = 0.5 * (at[i] + at[(i + 1) % 4]);
    toml += fmt::format("[[joint]]\nkind = \"weld\"\nbodies = [\"r{}\", \"r{}\"]\nat = [{}, {}]\n",
                        i, (i + 1) % 4, middle.x(), middle.y() + 0.05);
  }
  Simulation run(toml, Mode::Merge);
  run.until(2.0);
  ASSERT_TRUE(run.merged("r0"));
  run.kick("r3", {0.1, 0.0});
  run.until(4.0);
  for (const JointView& joint : run.now().joints) {
    EXPECT_LT(joint.force.norm(), 4 * 0.98 * 0.98 * 9.81);
    EXPECT_TRUE(std::isfinite(joint.torque));
  }
}

/// Two planks side by side on the ground, joined so that a motor presses them against a limit; a
/// stone falls on them.
std::string motorAtItsLimit(const std::string& joint) {
  return kGround + R"(
[[body]]
name = "left"
at = [0, 0.1]
box = [0.6, 0.2]
[[body]]
name = "right"
at = [0.7, 0.1]
box = [0.6, 0.2]
[[body]]
name = "stone"
at = [0.35, 2]
angle = 20
box = [0.4, 0.4]
pinned_until = 1.0
[[joint]]
bodies = ["left", "right"]
at = [0.35, 0.1]
)" + joint;
}

TEST(JointSystem, AMotorThatPressesAgainstALimitGainsNoEnergy) {
  const double fall = std::sqrt(2.0 * 9.81 * 2.0);  // m/s
  for (const char* joint :
       {"kind = \"prismatic\"\naxis = [1, 0.4]\nlimits = [0, 0.1]\n"
        "motor = { speed = 0.5, force = 10 }\n",
        "kind = \"revolute\"\nlimits = [0, 20]\nmotor = { speed = 50, torque = 3 }\n"}) {
    for (const Mode mode : {Mode::Reference, Mode::Merge, Mode::MergeSleep}) {
      Simulation run(motorAtItsLimit(joint), mode);
      double fastest = 0.0;
      run.steps(300, [&] {
        for (const BodyState& b : run.now().bodies) fastest = std::max(fastest, b.v.norm());
      });
      EXPECT_LT(fastest, fall) << name(mode) << "\n" << joint;
      EXPECT_LT(std::abs(run.body("stone").x.y()), 0.6) << name(mode) << "\n" << joint;
    }
  }
}

}  // namespace
}  // namespace merge2d
