/// Magnets grab and let go, also what is merged.

#include <fmt/format.h>

#include <numbers>

#include "tests/src2d/merging/merging_testing.h"

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

TEST(Magnet, MergesWithWhatHangsFromIt) {
  Simulation run(kCrane, Mode::Merge);
  run.until(1.0);
  EXPECT_TRUE(run.merged("container"));
  EXPECT_EQ(run.now().stats.contacts, 0);
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
