/// Welds that break as a slope tilts, or as a platform accelerates.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "src2d/merging/unmerge.h"
#include "tests/support/merging_testing.h"
#include "tests/support/modes_and_steps.h"

namespace merge2d {
namespace {

constexpr double kWay = 0.01;  ///< of a block that slides [m]

/// The angle [degrees] at which a block on a slope that tilts by 1° per second has slid by `kWay`.
double slidingAngle(Mode mode, const Overrides& overrides = {}, double h = 0.01) {
  Scene scene = parseScene(R"(
format = 1
[[body]]
name = "slope"
motion = "scripted"
at = [0, -0.5]
box = [20, 1]
script = { spin = 1 }
[[body]]
name = "block"
at = [0, 0.25]
box = [1, 0.5]
)",
                           "test.toml", overrides);
  scene.step = h;
  Simulation run(scene, mode);
  const auto place = [&] { return seenFrom(run.body("slope"), run.body("block")).position.x(); };
  run.until(5.0);
  const double start = place();
  while (run.world().time() < 45.0) {
    run.steps(1);
    if (std::abs(place() - start) > kWay) return run.body("slope").angle / kDegree;
  }
  return 45.0;
}

/// From θ₀ = atan μ = 30.964° on it accelerates with g ω t / cos θ₀, so that kWay takes 0.670 s.
TEST(Unmerge, ABlockOnATiltingSlopeSlidesAsInTheReference) {
  const double angle = std::atan(0.6);
  const double time = std::cbrt(6.0 * kWay * std::cos(angle) / (kGravity * kDegree));
  const double exact = angle / kDegree + time;  // 31.634°
  for (const double h : kStepSizes) {
    const double reference = slidingAngle(Mode::Reference, {}, h);
    EXPECT_NEAR(reference, exact, 0.05) << h;
    for (const Mode mode : {Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
      EXPECT_NEAR(slidingAngle(mode, {}, h), reference, 0.05) << name(mode) << ", " << h;
      EXPECT_NEAR(slidingAngle(mode, {}, h), exact, 0.05) << name(mode) << ", " << h;
    }
  }
}

TEST(Unmerge, UnderThePapersRuleTheBlockSticksForDegreesMore) {
  EXPECT_NEAR(slidingAngle(Mode::Merge, kPaper), 36.05, 0.05);
  EXPECT_GT(slidingAngle(Mode::Merge, kPaper), slidingAngle(Mode::Reference) + 3.0);
}

/// How far a box slips on a platform that is pushed with so many m/s², more than μg = 5.886 m/s²,
/// from second 2 for one second [m].
double slipOnPlatform(Mode mode, const Overrides& overrides = {}, double acceleration = 6.5,
                      double h = 0.01) {
  const std::string force = std::to_string(1000.0 * acceleration + 0.6 * 9.81);
  Scene scene = parseScene(kGround + R"(
friction = 0
[[body]]
name = "platform"
at = [0, 0.5]
box = [30, 1]
mass = 1000
[[body]]
name = "box"
at = [0, 1.5]
box = [1, 1]
[[force]]
body = "platform"
force = [)" + force + R"(, 0]
from = 2
)",
                           "test.toml", overrides);
  scene.step = h;
  Simulation run(scene, mode);
  run.until(2.0);
  const double before = seenFrom(run.body("platform"), run.body("box")).position.x();
  EXPECT_EQ(run.merged("box"), merges(mode));
  run.until(3.0);
  return seenFrom(run.body("platform"), run.body("box")).position.x() - before;
}

/// Symplectic Euler is ahead by the speed times h / 2, which is a part h of the way in a second.
TEST(Unmerge, ABoxSlipsOnAPlatformThatAcceleratesTooFast) {
  for (const double acceleration : {6.0, 6.5}) {
    for (const double h : kStepSizes) {
      const double exact = -0.5 * (acceleration - 0.6 * kGravity);  // −0.057 and −0.307 m
      const double reference = slipOnPlatform(Mode::Reference, {}, acceleration, h);
      EXPECT_NEAR(reference, exact, 0.02 * -exact) << acceleration << ", " << h;
      for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
        EXPECT_NEAR(slipOnPlatform(mode, {}, acceleration, h), reference, 0.005 * -exact)
            << name(mode) << ", " << acceleration << ", " << h;
      }
    }
  }
}

TEST(Unmerge, ABoxStaysOnAPlatformThatAcceleratesSlowly) {
  EXPECT_NEAR(slipOnPlatform(Mode::Merge, {}, 5.5), 0.0, 1e-3);
}

/// What swings sideways for ever in 4 s, with this largest acceleration [m/s²].
std::string swinging(double peak) {
  const double omega = 2.0 * std::numbers::pi / 4.0;
  return fmt::format("script = {{ axis = [1, 0], amplitude = {}, period = 4 }}\n",
                     peak / (omega * omega));
}

/// How far a box slips to and fro on a swinging platform [m].
double slipOnSwing(Mode mode, double peak, double h) {
  Scene scene = sceneOf(
      "[[body]]\nname = \"platform\"\nmotion = \"scripted\"\nat = [0, -0.5]\nbox = [40, 1]\n" +
      swinging(peak) + "[[body]]\nname = \"box\"\nat = [0, 0.5]\nbox = [1, 1]\n");
  scene.step = h;
  Simulation run(scene, mode);
  run.until(8.0);
  double least = 99.0, most = -99.0;
  while (run.world().time() < 12.0) {
    run.steps(1);
    const double place = seenFrom(run.body("platform"), run.body("box")).position.x();
    least = std::min(least, place);
    most = std::max(most, place);
  }
  return most - least;
}

/// With a peak of 6.0 m/s² it slips by 4 mm in a quarter of a second, in which it gains no more
/// than 2 cm/s: that is 15 steps of 1/60 s, of which one sooner or later is a tenth of the way.
TEST(Unmerge, ABoxSlipsAtThePeaksOfASwingAsInTheReference) {
  for (const double peak : {6.0, 6.5}) {
    for (const double h : kStepSizes) {
      const double reference = slipOnSwing(Mode::Reference, peak, h);
      EXPECT_GT(reference, peak == 6.0 ? 0.0035 : 0.1);
      const double part = peak == 6.0 ? (h > 0.015 ? 0.1 : 0.05) : 0.015;
      for (const Mode mode : {Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
        EXPECT_NEAR(slipOnSwing(mode, peak, h), reference, part * reference)
            << name(mode) << ", " << peak << ", " << h;
      }
    }
  }
}

/// The number of the step in which a beam has turned by 15 degrees that lies over the rear edge of
/// a platform, with its centre `inside` the edge [m], or 9999. The platform is pushed from 4 s on.
double stepOfBeamsFall(Mode mode, double acceleration, double inside, double h) {
  Scene scene = sceneOf(fmt::format(R"(
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [400, 1]
friction = 0
[[body]]
name = "platform"
at = [0, 0.75]
box = [40, 1.5]
mass = 1000
[[force]]
body = "platform"
force = [{}, 0]
from = 4
[[body]]
name = "beam"
at = [{}, 1.625]
box = [4, 0.25]
)",
                                    1000.0 * acceleration + 0.6 * kGravity, inside - 20.0));
  scene.step = h;
  Simulation run(scene, mode);
  run.until(4.0);
  EXPECT_EQ(run.merged("beam"), merges(mode));
  while (run.world().time() < 8.0) {
    run.steps(1);
    if (std::abs(run.body("beam").angle) > 15.0 * kDegree)
      return std::round(run.world().time() / h);
  }
  return 9999.0;
}

/// Within 7.6 cm of the edge its inertia tips it at once; from farther inside it slips there first.
TEST(Unmerge, ABeamFallsOverTheEdgeOfAPlatformAsInTheReference) {
  for (const double acceleration : {6.0, 6.5}) {
    for (const double inside : {0.002, 0.02, 0.05, 0.1}) {
      for (const double h : kStepSizes) {
        const double reference = stepOfBeamsFall(Mode::Reference, acceleration, inside, h);
        EXPECT_LT(reference, 9999.0);
        for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
          EXPECT_NEAR(stepOfBeamsFall(mode, acceleration, inside, h), reference, 2.0)
              << name(mode) << ", " << acceleration << ", " << inside << ", " << h;
        }
      }
    }
  }
}

/// Two contacts are fewer than three: its motion is looked at, though slip in one sweep is not
/// seen.
TEST(Unmerge, UnderThePapersRuleTheBoxSlipsToo) {
  EXPECT_NEAR(slipOnPlatform(Mode::Merge, kPaper), slipOnPlatform(Mode::Reference), 0.05);
}

/// A box sleeps on a platform that then goes sideways by a smooth way of two seconds, with up to
/// `peak`, more than μg, at both ends [m/s²].
double slipAfterSleep(Mode mode, double peak, const Overrides& rule = {}) {
  Simulation run(fmt::format(R"(
format = 1
[[body]]
name = "platform"
motion = "scripted"
box = [40, 1]
script = {{ keyframes = [[4, 0, -0.5, 0], [6, {}, -0.5, 0]] }}
[[body]]
name = "box"
at = [0, 0.5]
box = [1, 1]
)",
                             peak * 2.0 * 2.0 / 6.0),
                 mode, rule);
  run.until(4.0);
  const double before = seenFrom(run.body("platform"), run.body("box")).position.x();
  run.until(8.0);
  return seenFrom(run.body("platform"), run.body("box")).position.x() - before;
}

/// It slips by 2.2 and 62 mm. With a peak of 6.0 m/s², which lasts for two steps, it slips by less
/// than the 0.1 mm by which friction gives way in the reference.
TEST(Unmerge, ASleepingBoxSlipsWhenThePlatformBelowIsJerkedAway) {
  for (const double peak : {6.5, 8.0}) {
    const double reference = slipAfterSleep(Mode::Reference, peak);
    EXPECT_GT(std::abs(reference), peak < 7.0 ? 0.002 : 0.05);
    for (const Mode mode : {Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
      EXPECT_NEAR(slipAfterSleep(mode, peak), reference, 0.02 * std::abs(reference))
          << name(mode) << ", " << peak;
    }
  }
  for (const Mode mode : kAllModes) EXPECT_NEAR(slipAfterSleep(mode, 6.0), 0.0, 1e-4) << name(mode);
}

}  // namespace
}  // namespace merge2d
