/// Joints are as hard as they are said to be, under any load.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "src2d/dynamics/joint_solver.h"
#include "tests/support/modes_and_steps.h"

namespace merge2d {
namespace {

constexpr double kLink = 0.5;    // [m]
constexpr double kLength = 5.5;  // from the hook to the centre of the ball [m]

/// Ten links of 1 kg, in a line at `angle` from the vertical, and a ball of `mass` at their end.
std::string chain(double mass, double angle = 0.0) {
  const auto at = [&](double way) {
    return fmt::format("[{}, {}]", way * std::sin(angle), -way * std::cos(angle));
  };
  std::string toml = "[[body]]\nname = \"hook\"\nmotion = \"pinned\"\nbox = [0.1, 0.1]\n";
  std::string before = "hook";
  const auto join = [&](const std::string& name, double way) {
    toml += fmt::format("[[joint]]\nkind = \"revolute\"\nbodies = [\"{}\", \"{}\"]\nat = {}\n",
                        before, name, at(way));
    before = name;
  };
  for (int i = 0; i < 10; ++i) {
    const std::string name = fmt::format("link{}", i);
    toml += fmt::format(
        "[[body]]\nname = \"{}\"\nat = {}\nangle = {}\nbox = [0.1, 0.46]\n"
        "mass = 1\n",
        name, at((i + 0.5) * kLink), angle / kDegree);
    join(name, i * kLink);
  }
  toml += fmt::format("[[body]]\nname = \"ball\"\nat = {}\ncircle = 0.5\nmass = {}\n", at(kLength),
                      mass);
  join("ball", 10 * kLink);
  return toml;
}

/// The farthest that the two ends of any joint are apart [m].
double widestGap(const World& world) {
  double widest = 0.0;
  for (const JointView& joint : world.capture().joints) {
    widest = std::max(widest, (joint.to - joint.from).norm());
  }
  return widest;
}

// The tolerance is a hundredth of the required one: 0.001 % of the length.
TEST(Chain, HangsAsLongAsItIs) {
  for (const double mass : {1.0, 10.0, 100.0, 1000.0, 10000.0}) {
    SCOPED_TRACE(mass);
    inEachModeAndStep([&](Mode mode, double h) {
      World world = worldOf(chain(mass), mode, h);
      runSeconds(world, 5.0);
      EXPECT_NEAR(see(world, "ball").x.y(), -kLength, 1e-5 * kLength);
    });
  }
}

// Paths bend: the tolerance is a tenth of 0.1 % of the length. Without a heavy ball the chain is a
// whip, whose last link turns by half a radian in a step: there it is a fiftieth.
TEST(Chain, StaysAsLongAsItIsWhileItSwings) {
  for (const double mass : {1.0, 100.0, 1000.0}) {
    SCOPED_TRACE(mass);
    const double part = mass > 1.0 ? 1e-4 : 2e-2;
    inEachModeAndStep([&](Mode mode, double h) {
      World world = worldOf(chain(mass, 60 * kDegree), mode, h);
      double widest = 0.0, longest = 0.0;
      while (world.time() < 6.0) {
        world.step();
        widest = std::max(widest, widestGap(world));
        longest = std::max(longest, see(world, "ball").x.norm());
      }
      EXPECT_LT(widest, part * kLength);
      EXPECT_LT(longest, (1.0 + part) * kLength);
    });
  }
}

// Rods and ropes between discs, which themselves do not turn.
TEST(Chain, RodsAndRopesStayAsLongAsTheyAreToo) {
  for (const char* kind : {"", "limits = [0, 0.5]\n"}) {
    SCOPED_TRACE(kind);
    std::string toml = "[[body]]\nname = \"disc0\"\nmotion = \"pinned\"\ncircle = 0.1\n";
    const Vec2 along(std::sin(60 * kDegree), -std::cos(60 * kDegree));
    for (int i = 1; i <= 11; ++i) {
      const Vec2 from = (i - 1) * kLink * along, to = i * kLink * along;
      toml += fmt::format(
          "[[body]]\nname = \"disc{0}\"\nat = [{1}, {2}]\ncircle = 0.1\n"
          "mass = {3}\n[[joint]]\nkind = \"distance\"\n"
          "bodies = [\"disc{4}\", \"disc{0}\"]\nat = [{5}, {6}]\n"
          "to = [{1}, {2}]\n{7}",
          i, to.x(), to.y(), i < 11 ? 1 : 100, i - 1, from.x(), from.y(), kind);
    }
    inEachModeAndStep([&](Mode mode, double h) {
      World world = worldOf(toml, mode, h);
      double longest = 0.0;
      while (world.time() < 6.0) {
        world.step();
        longest = std::max(longest, see(world, "disc11").x.norm());
      }
      EXPECT_LT(longest, 1.001 * kLength);
    });
  }
}

// A heavy ball keeps the chain straight: a pendulum, whose energy stays. Tolerance: 1 % of its
// energy at first, over four swings.
TEST(Chain, KeepsItsEnergyWhileItSwings) {
  inEachModeAndStep([](Mode mode, double h) {
    World world = worldOf(chain(1000.0, 60 * kDegree), mode, h);
    const double before = world.capture().stats.potential_energy;
    runSeconds(world, 20.0);
    const Stats after = world.capture().stats;
    const double swing = 1000.0 * kGravity * kLength * 0.5;
    EXPECT_NEAR((after.kinetic_energy + after.potential_energy - before) / swing, 0.0, 0.01);
  });
}

/// A bridge of `n` planks of 1 m and 1 kg between two points of the world that are `n` metres
/// apart, and a load of `mass` that falls on it from 1 cm.
std::string bridge(int n, double mass) {
  std::string toml, joined;
  for (int i = 0; i < n; ++i) {
    toml += fmt::format(
        "[[body]]\nname = \"plank{0}\"\nat = [{1}, 0]\nbox = [0.9, 0.1]\nmass = 1\n"
        "[[joint]]\nkind = \"revolute\"\nbodies = [{2}\"plank{0}\"]\nat = [{0}, 0]\n",
        i, i + 0.5, joined);
    joined = fmt::format("\"plank{}\", ", i);
  }
  toml += fmt::format("[[joint]]\nkind = \"revolute\"\nbodies = [\"plank{}\"]\nat = [{}, 0]\n",
                      n - 1, n);
  if (mass > 0.0) {
    toml += fmt::format("[[body]]\nname = \"load\"\nat = [{}, 0.56]\nbox = [1, 1]\nmass = {}\n",
                        0.5 * n, mass);
  }
  return toml;
}

// It cannot sag without stretching, and nothing in it holds it level: it hangs by a hair. Its
// joints open by less than 2 % of a plank under ten times its own weight, and it comes to rest; a
// plank that falls from there is faster than 1 m/s.
TEST(Chain, ABridgeWithoutSlackStaysWhereItIs) {
  for (const int planks : {2, 4, 12}) {
    for (const double mass : {0.0, 10.0}) {
      inEachModeAndStep([&](Mode mode, double h) {
        SCOPED_TRACE(::testing::Message() << planks << " planks, " << mass << " kg");
        World world = worldOf(bridge(planks, mass), mode, h);
        double widest = 0.0, highest = 0.0;
        while (world.time() < 6.0) {
          world.step();
          widest = std::max(widest, widestGap(world));
          highest = std::max(highest, see(world, "plank0").x.y());
        }
        EXPECT_LT(widest, 0.02);
        EXPECT_LT(highest, 0.05);
        EXPECT_LT(fastest(world), 1.4);
      });
    }
  }
}

// Merged to one body it has a row more than freedoms: the distance along the line between its two
// ends must not turn it. Tolerance: two millimetres, with which it may merge.
TEST(Chain, ALoadThatMergesWithABridgeOpensItNoFurther) {
  for (const int planks : {2, 3}) {
    for (const double mass : {30.0, 100.0, 300.0, 1000.0}) {
      for (const double h : {1.0 / 60, 0.01, 1.0 / 240}) {
        SCOPED_TRACE(::testing::Message() << planks << " planks, " << mass << " kg, h = " << h);
        const auto gap = [&](Mode mode) {
          World world = worldOf(bridge(planks, mass), mode, h);
          double widest = 0.0;
          while (world.time() < 4.0) {
            world.step();
            widest = std::max(widest, widestGap(world));
          }
          return widest;
        };
        const double reference = gap(Mode::Reference);
        for (const Mode mode : {Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
          EXPECT_LT(gap(mode), 1.1 * reference + 0.002);
        }
      }
    }
  }
}

// The loop of planks and beam has four rows more than freedoms. Errors of a few micrometres, with
// which the planks merge, contradict each other and must not become a stress that is let go later.
// The load falls by 1 cm and stays down; the gaps
// are those with which the loop merges.
TEST(Chain, ALoopThatMergesWithItsErrorsIsNotUnderStress) {
  for (const double mass : {10.0, 100.0}) {
    const std::string beam =
        "[[body]]\nname = \"beam\"\nat = [1, -0.3]\nbox = [2, 0.1]\nmass = 5\n"
        "[[joint]]\nkind = \"revolute\"\nbodies = [\"beam\"]\nat = [0, 0]\n"
        "[[joint]]\nkind = \"revolute\"\nbodies = [\"beam\"]\nat = [2, 0]\n"
        "[[joint]]\nkind = \"revolute\"\nbodies = [\"beam\", \"plank1\"]\nat = [1, 0]\n";
    inEachModeAndStep([&](Mode mode, double h) {
      World world = worldOf(bridge(2, mass) + beam, mode, h);
      double highest = 0.0;
      while (world.time() < 3.0) {
        world.step();
        if (world.time() > 0.1) highest = std::max(highest, see(world, "load").x.y());
      }
      EXPECT_LT(highest, 0.551);
      EXPECT_LT(widestGap(world), 0.002);
    });
  }
}

// By so many metres per newton, whatever its kind; without the key by none. An implicit spring
// comes to rest by itself.
TEST(Chain, GivesWayByItsCompliance) {
  for (const char* kind :
       {"\"revolute\"", "\"weld\"", "\"prismatic\"\naxis = [1, 0]", "\"distance\"\nto = [0, 0]"}) {
    for (const double compliance : {0.0, 0.002}) {
      SCOPED_TRACE(::testing::Message() << kind << ", " << compliance << " m/N");
      const std::string key = compliance > 0.0 ? fmt::format("compliance = {}\n", compliance) : "";
      const std::string toml = fmt::format(
          "[[body]]\nname = \"lamp\"\nat = [0, -1]\ncircle = 0.2\nmass = 5\n"
          "[[joint]]\nkind = {}\nbodies = [\"lamp\"]\nat = [0, -1]\n{}",
          kind, key);
      inEachModeAndStep([&](Mode mode, double h) {
        World world = worldOf(toml, mode, h);
        runSeconds(world, 60.0);
        EXPECT_NEAR(see(world, "lamp").x.y(), -1.0 - compliance * 5 * kGravity, 1e-4);
      });
    }
  }
}

// Fixed by more joints than it needs: each bears a share, and none more than the weight.
TEST(Chain, JointsThatSayTheSameShareTheLoad) {
  std::string toml = R"(
[[body]]
name = "shelf"
at = [0, 0]
box = [2, 0.1]
mass = 4
)";
  for (const double x : {-0.9, -0.3, 0.3, 0.9}) {
    toml += fmt::format("[[joint]]\nkind = \"revolute\"\nbodies = [\"shelf\"]\nat = [{}, 0]\n", x);
  }
  toml += "[[joint]]\nkind = \"weld\"\nbodies = [\"shelf\"]\nat = [0, 0]\n";
  inEachModeAndStep([&](Mode mode, double h) {
    World world = worldOf(toml, mode, h);
    runSeconds(world, 5.0);
    EXPECT_NEAR(see(world, "shelf").x.y(), 0.0, 1e-3);
    double borne = 0.0;
    for (const JointView& joint : world.capture().joints) {
      EXPECT_LT(joint.force.norm(), 1.5 * 4 * kGravity);
      borne += joint.force.y();
    }
    EXPECT_NEAR(std::abs(borne), 4 * kGravity, 0.1);
  });
}

/// A swing seat of 50 kg on two bars, which stays level: a loop through the world; and a triangle
/// of bars, hung at a corner: one through bodies alone.
const std::string kLoops = R"(
[[body]]
name = "left"
at = [0.25, -0.4330127019]
angle = 30
box = [0.1, 1]
mass = 1
[[body]]
name = "right"
at = [2.25, -0.4330127019]
angle = 30
box = [0.1, 1]
mass = 1
[[body]]
name = "seat"
at = [1.5, -0.8660254038]
box = [2, 0.1]
mass = 50
[[joint]]
kind = "revolute"
bodies = ["left"]
at = [0, 0]
[[joint]]
kind = "revolute"
bodies = ["right"]
at = [2, 0]
[[joint]]
kind = "revolute"
bodies = ["left", "seat"]
at = [0.5, -0.8660254038]
[[joint]]
kind = "revolute"
bodies = ["right", "seat"]
at = [2.5, -0.8660254038]

[[body]]
name = "beam"
at = [7, 0]
box = [2, 0.1]
mass = 1
[[body]]
name = "up"
at = [6.5, 0.8660254038]
angle = 60
box = [2, 0.1]
mass = 1
[[body]]
name = "down"
at = [7.5, 0.8660254038]
angle = -60
box = [2, 0.1]
mass = 40
[[joint]]
kind = "revolute"
bodies = ["beam", "up"]
at = [6, 0]
[[joint]]
kind = "revolute"
bodies = ["beam", "down"]
at = [8, 0]
[[joint]]
kind = "revolute"
bodies = ["up", "down"]
at = [7, 1.7320508076]
[[joint]]
kind = "revolute"
bodies = ["up"]
at = [6, 0]
)";

// The tolerance is that of the swinging chain.
TEST(Chain, LoopsOfJointsHoldToo) {
  inEachModeAndStep([](Mode mode, double h) {
    World world = worldOf(kLoops, mode, h);
    double widest = 0.0, slant = 0.0;
    while (world.time() < 5.0) {
      world.step();
      widest = std::max(widest, widestGap(world));
      slant = std::max(slant, std::abs(see(world, "seat").angle));
    }
    EXPECT_LT(widest, 1e-4 * kLength);
    EXPECT_LT(slant, 1e-3);
  });
}

}  // namespace
}  // namespace merge2d
