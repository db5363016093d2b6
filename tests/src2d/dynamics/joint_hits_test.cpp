/// Joints while hits go on (dynamics/hits.h).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "tests/support/modes_and_steps.h"

namespace merge2d {
namespace {

/// A ball that falls on a floor at 3 m/s, and a joint from it to a point on the left.
std::string tetheredBall(double e, const std::string& joint) {
  return fmt::format(R"(
gravity = [0, 0]
[material]
friction = 0
restitution = {}
[[body]]
name = "floor"
motion = "pinned"
at = [0, -0.5]
box = [60, 1]
[[body]]
name = "ball"
at = [0, 0.6]
circle = 0.1
mass = 1
velocity = [0, -3]
[[joint]]
bodies = ["ball"]
at = [0, 0.6]
{}
)",
                     e, joint);
}

/// A limit that is far away is as none.
TEST(JointHits, ALimitThatIsNotReachedIsNoPartOfAHit) {
  for (const char* joint : {"kind = 'distance'\nto = [-1.6, 1.2]\nlimits = [0, 8]",
                            "kind = 'distance'\nto = [-1.6, 1.2]\nlimits = [0.2, 9]",
                            "kind = 'prismatic'\naxis = [0, 1]\nlimits = [-9, 9]"}) {
    for (const double e : {0.5, 1.0}) {
      SCOPED_TRACE(testing::Message() << joint << ", e = " << e);
      for (const double h : kStepSizes) {
        World world = worldOf(tetheredBall(e, joint), Mode::Reference, h);
        runSeconds(world, 0.4);
        EXPECT_NEAR(see(world, "ball").v.x(), 0.0, 1e-9);
        EXPECT_NEAR(see(world, "ball").v.y(), 3.0 * e, 1e-9);
      }
    }
  }
}

/// Two discs, one behind the other at 3 m/s, that come to a wall; `joint` holds them at 1 m.
std::string pairBeforeAWall(const std::string& joint) {
  return R"(
gravity = [0, 0]
[material]
restitution = 1
friction = 0
[[body]]
name = "wall"
motion = "pinned"
at = [5, 0]
box = [1, 10]
[[body]]
name = "front"
at = [3, 0]
circle = 0.2
mass = 1
velocity = [3, 0]
[[body]]
name = "back"
at = [2, 0]
circle = 0.2
mass = 1
velocity = [3, 0]
[[joint]]
kind = "distance"
bodies = ["front", "back"]
at = [3, 0]
to = [2, 0]
)" + joint;
}

/// The one that hits the wall comes back at once; the other one has not heard of it yet.
TEST(JointHits, ASoftSpringPassesNoHitOn) {
  for (const double h : kStepSizes) {
    World world = worldOf(pairBeforeAWall("stiffness = 1"), Mode::Reference, h);
    while (see(world, "front").v.x() > 0.0 && world.time() < 3.0) world.step();
    EXPECT_NEAR(see(world, "front").v.x(), -3.0, 0.05);
    EXPECT_NEAR(see(world, "back").v.x(), 3.0, 0.05);
  }
}

/// The one in front comes back from the wall, and the limit is reached a little later in the step:
/// both stop there, whatever the step.
TEST(JointHits, ALimitIsReachedAfterAHitInTheSameStep) {
  for (const double least : {0.985, 0.999}) {
    const std::string pair = pairBeforeAWall(fmt::format("limits = [{}, 1.1]", least));
    for (const double h : kStepSizes) {
      World world = worldOf(pair, Mode::Reference, h);
      runSeconds(world, 1.0);
      const double way = 0.5 * (1.0 - least);  // of each, against the other, after the hit
      EXPECT_NEAR(see(world, "front").x.x(), 4.3 - way, 1e-9);
      EXPECT_NEAR(see(world, "back").x.x(), 3.3 + way, 1e-9);
      EXPECT_NEAR(see(world, "front").v.x(), 0.0, 1e-9);
      EXPECT_NEAR(see(world, "back").v.x(), 0.0, 1e-9);
    }
  }
}

/// Hinged or on a rod, spinning: the joint's impulses act where the bodies are at the hit.
TEST(JointHits, KeepTheAngularMomentum) {
  for (const char* joint :
       {"kind = 'distance'\nat = [0, 0]\nto = [1, 0]", "kind = 'revolute'\nat = [0.5, 0]",
        "kind = 'weld'\nat = [0.5, 0]", "kind = 'prismatic'\nat = [0.5, 0]\naxis = [1, 0]"}) {
    SCOPED_TRACE(joint);
    for (const double h : kStepSizes) {
      World world = worldOf(fmt::format(R"(
gravity = [0, 0]
[material]
restitution = 0.8
friction = 0.5
[[body]]
name = "a"
at = [0, 0]
box = [0.6, 0.3]
mass = 1
velocity = [0, -2]
spin = 229
[[body]]
name = "b"
at = [1, 0]
box = [0.6, 0.3]
mass = 2
velocity = [0, 2]
spin = 229
[[joint]]
bodies = ["a", "b"]
{}
[[body]]
name = "shot"
at = [0.2, 4]
circle = 0.2
mass = 3
velocity = [0.1, -5]
)",
                                        joint),
                            Mode::Reference, h);
      const double before = world.capture().stats.angular_momentum;
      runSeconds(world, 2.0);
      EXPECT_GT(std::abs(see(world, "shot").v.y() + 5.0), 0.1);
      EXPECT_NEAR(world.capture().stats.angular_momentum, before, 1e-9);
    }
  }
}

/// Six bodies in a box of 4 m by 5 m, which joints of all kinds hold to each other.
std::string boxOfJoints(std::mt19937& random) {
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  std::string toml = R"(
gravity = [0, 0]
[material]
restitution = 0.9
friction = 0.3
)";
  const auto addWall = [&](double x, double y, double width, double height) {
    toml += fmt::format("[[body]]\nmotion = 'pinned'\nat = [{}, {}]\nbox = [{}, {}]\n", x, y, width,
                        height);
  };
  addWall(0.5, -1.5, 8, 1), addWall(0.5, 4.5, 8, 1), addWall(-2, 1.5, 1, 8), addWall(3, 1.5, 1, 8);
  for (int i = 0; i < 6; ++i) {
    toml += fmt::format(
        "[[body]]\nname = 'b{}'\nat = [{}, {}]\n{}\nvelocity = [{:.3f}, {:.3f}]\nspin = {:.1f}\n",
        i, i % 2, 1.5 * (i / 2), random() % 2 ? "circle = 0.3" : "box = [0.6, 0.4]", uniform(-5, 5),
        uniform(-5, 5), uniform(-300, 300));
  }
  const std::array kinds{
      "kind = 'distance'\nat = [0.0, {0}]\nto = [1.0, {0}]",
      "kind = 'distance'\nat = [0.0, {0}]\nto = [1.0, {0}]\nlimits = [0.9, 1.1]",
      "kind = 'distance'\nat = [0.0, {0}]\nto = [1.0, {0}]\nlimits = [0.1, 3]",
      "kind = 'revolute'\nat = [0.5, {0}]",
      "kind = 'prismatic'\nat = [0.5, {0}]\naxis = [1, 0]\nlimits = [-0.2, 0.3]"};
  for (int row = 0; row < 3; ++row) {
    toml += fmt::format("[[joint]]\nbodies = ['b{}', 'b{}']\n", 2 * row, 2 * row + 1) +
            fmt::format(fmt::runtime(kinds[random() % kinds.size()]), 1.5 * row) + "\n";
  }
  return toml;
}

TEST(JointHits, AddNoEnergy) {
  std::mt19937 random(3);
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    const std::string toml = boxOfJoints(random);
    for (const double h : kStepSizes) {
      World world = worldOf(toml, Mode::Reference, h);
      const double before = world.capture().stats.kinetic_energy;
      for (int step = 0; step < 300; ++step) {
        world.step();
        ASSERT_LE(world.capture().stats.kinetic_energy, 1.02 * before) << world.time();
      }
    }
  }
}

}  // namespace
}  // namespace merge2d
