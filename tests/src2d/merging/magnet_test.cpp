/// Magnets grab and let go, also what is merged.

#include <fmt/format.h>

#include <numbers>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

/// A magnet that hangs still and holds a container from above between 0 and 2 s.
const std::string kCrane = R"(
format = 1
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [40, 1]
[[body]]
name = "magnet"
motion = "pinned"
at = [0, 5.1]
box = [1, 0.2]
[[body]]
name = "container"
at = [0, 4.5]
box = [2, 1]
[[magnet]]
body = "magnet"
on = [[0, 2]]
)";

TEST(Magnet, HoldsWhatHangsFromIt) {
  for (const Mode mode : {Mode::Reference, Mode::MergeSleep}) {
    Simulation run(kCrane, mode);
    run.until(2.0);
    EXPECT_NEAR(run.body("container").x.y(), 4.5, 1e-3);
    EXPECT_NEAR(normalForce(run.now(), run.id("magnet"), run.id("container"), 0.01), -2 * kGravity,
                0.01);
  }
}

/// What comes near fast has contacts far ahead of it, and a magnet must not close them all within a
/// step: a bar that hit it with its corner left with six times its energy.
TEST(Magnet, AddsNoEnergyToWhatSpinsPast) {
  constexpr double kBarMass = 0.2, kInertia = kBarMass * (0.04 + 1.0) / 12.0;
  for (const double spin : {5.0, 10.0, 20.0, 30.0}) {  // rad/s
    for (const double distance : {0.02, 0.05, 0.1, 0.2}) {
      Simulation run(fmt::format(R"(
format = 1
gravity = [0, 0]
[[body]]
name = "magnet"
motion = "pinned"
at = [0, 0]
box = [1, 1]
[[body]]
name = "bar"
at = [{}, 0.3]
box = [0.2, 1]
velocity = [-1, 0]
spin = {}
[[magnet]]
body = "magnet"
)",
                                 0.6 + distance, spin * 180.0 / std::numbers::pi),
                     Mode::Reference);
      const double start = 0.5 * kBarMass + 0.5 * kInertia * spin * spin;
      double most = 0.0;
      for (int step = 0; step < 200; ++step) {
        run.steps(1);
        const BodyState bar = run.body("bar");
        const double energy =
            0.5 * kBarMass * bar.v.squaredNorm() + 0.5 * kInertia * bar.omega * bar.omega;
        most = std::max(most, energy);
      }
      EXPECT_LT(most, 1.001 * start) << spin << " rad/s, " << distance << " m";
    }
  }
}

/// Two boxes without weight: one comes to rest at the other, a magnet, at its own speed.
TEST(Magnet, TakesHoldWithoutABlow) {
  for (const double speed : {0.0, 0.02, 0.14, 0.3}) {  // m/s
    Simulation run(fmt::format(R"(
format = 1
gravity = [0, 0]
[[body]]
name = "magnet"
motion = "pinned"
at = [0, 0]
box = [1, 1]
[[body]]
name = "box"
at = [1.0045, 0]
box = [1, 1]
velocity = [-{}, 0]
[[magnet]]
body = "magnet"
)",
                               speed),
                   Mode::Reference);
    double fastest = 0.0, slowest_ahead = speed;
    for (int step = 0; step < 200; ++step) {
      const double gap = run.body("box").x.x() - 1.0;
      run.steps(1);
      const double v = -run.body("box").v.x();
      fastest = std::max(fastest, v);
      if (gap > speed * 0.01) slowest_ahead = std::min(slowest_ahead, v);
    }
    // 5% of 4.5 mm in a step, as an overlap is removed.
    EXPECT_LT(fastest, std::max(speed, 0.0225) + 1e-9) << speed;
    EXPECT_GT(slowest_ahead, speed - 1e-9) << speed << ": nothing stops it before it touches";
    EXPECT_NEAR(run.body("box").x.x(), 1.0, 1e-5) << speed;
  }
}

/// A ball that passes by at 20 m/s has contacts 20 cm ahead of it.
TEST(Magnet, LeavesWhatFliesPastAlone) {
  for (const double distance : {0.01, 0.05, 0.15}) {  // m
    Simulation run(fmt::format(R"(
format = 1
gravity = [0, 0]
[[body]]
name = "magnet"
motion = "pinned"
box = [1, 1]
[[body]]
name = "ball"
at = [-3, {}]
circle = 0.2
velocity = [20, 0]
[[magnet]]
body = "magnet"
)",
                               0.7 + distance),
                   Mode::Reference);
    run.until(0.3);
    EXPECT_NEAR(run.body("ball").x.x(), 3.0, 1e-9) << distance;
  }
}

/// A container stands on a slope, and a level magnet comes down to 1 mm above its higher end.
TEST(Magnet, DrawsAFaceFlatThatItTouchesAtOneEnd) {
  for (const double slope : {0.15, 0.3, 1.0, 3.0}) {  // degrees
    const double angle = slope * std::numbers::pi / 180.0;
    const Vec2 container = Pose::at(Vec2::Zero(), angle) * Vec2(0.0, 1.1);
    const double top = 1.7 / std::cos(angle) + 1.1 * std::tan(angle) + 0.001;
    const std::string crane = fmt::format(R"(
format = 1
[[body]]
name = "ground"
motion = "pinned"
at = [0, 0]
angle = {0}
box = [4, 1]
[[body]]
name = "container"
at = [{1}, {2}]
angle = {0}
box = [2.4, 1.2]
[[body]]
name = "magnet"
motion = "scripted"
box = [2.2, 0.4]
script = {{ keyframes = [[0, 0, 4, 0], [2, 0, {3}, 0], [3, 0, {3}, 0], [6, 0, 6, 0]] }}
[[magnet]]
body = "magnet"
)",
                                          slope, container.x(), container.y(), top + 0.2);
    for (const Mode mode : {Mode::Reference, Mode::MergeSleep}) {
      Simulation run(crane, mode);
      run.until(6.5);
      EXPECT_NEAR(run.body("container").angle, 0.0, 1e-4) << slope << " degrees, " << name(mode);
      EXPECT_NEAR(run.body("container").x.y(), 5.2, 1e-3) << slope << " degrees, " << name(mode);
    }
  }
}

TEST(Magnet, MergesWithWhatHangsFromIt) {
  Simulation run(kCrane, Mode::Merge);
  run.until(1.0);
  EXPECT_TRUE(run.merged("container"));
  EXPECT_EQ(run.now().stats.contacts, 0);
}

/// A sled glides on ice with two merged boxes on it, and a magnet comes down to the upper one.
TEST(Magnet, TakesAMemberOutOfItsCollectionAtOnce) {
  Simulation run(R"(
format = 1
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [40, 1]
friction = 0
[[body]]
name = "sled"
at = [-0.4, 0.25]
box = [6, 0.5]
mass = 500
velocity = [0.2, 0]
[[body]]
name = "box"
at = [-0.4, 1]
box = [2, 1]
velocity = [0.2, 0]
repeat = { count = [1, 2], spacing = [0, 1] }
[[body]]
name = "magnet"
motion = "scripted"
box = [1, 0.2]
script = { keyframes = [[0, 0, 4, 0], [2, 0, 2.602, 0], [2.2, 0, 2.602, 0], [4, 0, 5, 0]] }
[[magnet]]
body = "magnet"
)",
                 Mode::MergeSleep);
  const auto rides = [&](const std::string& name) {
    return run.merged(name) && run.body(name).collection == run.body("sled").collection;
  };
  run.until(1.5);
  EXPECT_TRUE(rides("box[0,1]"));
  double slowest = 1.0;
  run.steps(150, [&] {
    slowest = std::min(slowest, run.body("sled").v.x());
    EXPECT_TRUE(rides("box[0,0]"));
  });
  EXPECT_GT(slowest, 0.18) << "m/s: the upper box rubs on the lower one, and no more";
  EXPECT_NEAR(run.body("box[0,1]").x.x(), run.body("magnet").x.x() - 0.035, 0.05);
  EXPECT_GT(run.body("box[0,1]").x.y(), 2.2);
}

TEST(Magnet, LetsGoOfWhatItHasMergedWith) {
  for (const Mode mode : {Mode::Reference, Mode::Merge, Mode::MergeSleep}) {
    Simulation run(kCrane, mode);
    run.until(2.0);
    run.until(2.1);
    EXPECT_FALSE(run.merged("container"));
    run.until(2.5);
    // Falls freely, but for the steps in which the sum of its opening was too small to tell.
    EXPECT_NEAR(run.body("container").x.y(), 4.5 - 0.5 * kGravity * 0.25, 0.15);
    run.until(5.0);
    EXPECT_NEAR(run.body("container").x.y(), 0.5, 0.01);
  }
}

TEST(Magnet, LiftsAContainerAndPutsItDown) {
  const std::string crane = R"(
format = 1
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [40, 1]
[[body]]
name = "container"
at = [0, 0.5]
box = [2, 1]
repeat = { count = [1, 2], spacing = [0, 1] }
[[body]]
name = "magnet"
motion = "scripted"
box = [1, 0.2]
script = { keyframes = [[0, 0, 4, 0], [2, 0, 2.1, 0], [4, 0, 5, 0], [7, 6, 5, 0], [9, 6, 1.1, 0]] }
[[magnet]]
body = "magnet"
on = [[1.5, 9.5]]
)";
  for (const Mode mode : {Mode::Reference, Mode::MergeSleep}) {
    Simulation run(crane, mode);
    run.until(5.5);
    EXPECT_NEAR(run.body("container[0,1]").x.y(), 4.4, 0.02);
    EXPECT_NEAR(run.body("container[0,0]").x.y(), 0.5, 0.02);  // exactly the grabbed one
    run.until(11.0);
    EXPECT_NEAR(run.body("container[0,1]").x.x(), 6.0, 0.05);
    EXPECT_NEAR(run.body("container[0,1]").x.y(), 0.5, 0.02);
  }
}

}  // namespace
}  // namespace merge2d
