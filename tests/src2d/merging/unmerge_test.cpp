#include "src2d/merging/unmerge.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numeric>

#include "src2d/collections/cuts.h"
#include "src2d/state_file.h"
#include "tests/support/merging_testing.h"
#include "tests/support/modes_and_steps.h"

namespace merge2d {
namespace {

const std::string kSixBoxes = kGround + R"(
[[body]]
name = "box"
at = [0, 0.5]
box = [1, 1]
repeat = { count = [1, 6], spacing = [1, 1] }
)";

std::string boxName(int row) { return "box[0," + std::to_string(row) + "]"; }

TEST(Unmerge, FreesOnlyTheBodyThatWasHit) {
  Simulation run(kSixBoxes, Mode::Merge);
  run.until(3.0);
  const CollectionId pile = run.collectionOf(boxName(0));
  ASSERT_EQ(run.collectionOf(boxName(5)), pile);
  run.kick(boxName(5), {0.0, 2.0});
  run.steps(1);
  EXPECT_FALSE(run.merged(boxName(5)));
  EXPECT_EQ(events(run, EventType::Unmerge, EventReason::Broken), 1);
  for (int row = 0; row < 5; ++row) EXPECT_EQ(run.collectionOf(boxName(row)), pile) << row;
  EXPECT_NEAR(run.body(boxName(5)).v.y(), 2.0 - 9.81 * 0.01, 1e-9);
}

TEST(Unmerge, ABreakInTheMiddleLeavesTwoParts) {  // Figure 3
  Simulation run(kSixBoxes, Mode::Merge);
  run.until(3.0);
  const CollectionId pile = run.collectionOf(boxName(0));
  ASSERT_EQ(run.collectionOf(boxName(5)), pile);
  run.kick(boxName(3), {0.0, 6.0});  // throws boxes 3, 4 and 5 up by 2 m/s
  run.steps(1);
  const CollectionId upper = run.collectionOf(boxName(3));
  for (int row = 0; row < 3; ++row) EXPECT_EQ(run.collectionOf(boxName(row)), pile) << row;
  EXPECT_NE(upper, pile);
  for (int row = 3; row < 6; ++row) {
    EXPECT_EQ(run.collectionOf(boxName(row)), upper) << row;
    EXPECT_NEAR(run.body(boxName(row)).v.y(), 2.0 - 9.81 * 0.01, 0.02) << row;
  }
  for (int row = 0; row < 3; ++row) EXPECT_NEAR(run.body(boxName(row)).v.norm(), 0.0, 1e-9);
}

// ---- sliding ----

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

// ---- forces ----

/// The step in which a tall box on the ground leaves its collection when it is pushed from 1 s on.
int stepOfTipping(Mode mode, double push, const Overrides& rule = {}) {
  Simulation run(kGround + R"(
[[body]]
name = "box"
at = [0, 1]
box = [0.5, 2]
[[force]]
body = "box"
at = [-0.25, 1]
from = 1
force = [)" + std::to_string(push) +
                     ", 0]\n",
                 mode, rule);
  for (int step = 1; step <= 400; ++step) {
    run.steps(1);
    if (step >= 100 && !run.merged("box")) return step;
  }
  return -1;
}

TEST(Unmerge, APushThatTipsABoxIsFeltInTheStepInWhichItBegins) {
  for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {  // it takes 1.23 N
    EXPECT_EQ(stepOfTipping(mode, 1.35), 101) << name(mode);
    EXPECT_EQ(stepOfTipping(mode, 1.1), -1) << name(mode);
  }
}

TEST(Unmerge, UnderThePapersRuleAPushThatTipsABoxIsFeltStepsLater) {
  EXPECT_EQ(stepOfTipping(Mode::Merge, 1.35, kPaper), 114);
}

// ---- impacts ----

TEST(Unmerge, AProjectileMovesAsManyBodiesAsInTheReference) {
  const int iterations = SolverSettings{}.iterations;
  for (const Vec2& velocity : {Vec2(10.0, 1.0), Vec2(20.0, 1.0), Vec2(30.0, 8.0)}) {
    const int reference = movedByBall(Mode::Reference, velocity, 100);  // which has converged
    EXPECT_GT(reference, 5);
    EXPECT_NEAR(movedByBall(Mode::MergeSleep, velocity, iterations), reference, 0.3 * reference)
        << "at " << velocity.x() << " m/s";
  }
}

// ---- no flicker ----

TEST(Unmerge, AWeldThatBrokeAtOnceDoesNotFormAtOnce) {
  // A box is knocked as soon as it has merged, and comes to rest again within a few steps.
  const auto stepsApart = [](const Overrides& overrides) {
    Simulation run(kGround + R"(
[[body]]
name = "box"
at = [0, 0.5]
box = [1, 1]
)",
                   Mode::Merge, overrides);
    std::int64_t parted = 0, again = 0;
    bool kicked = false;
    run.steps(100, [&] {
      const bool merged = run.merged("box");
      const std::int64_t step = run.world().steps();
      if (merged && !kicked) run.kick("box", {0.1, 0.0}, {0.0, -0.4});
      if (!merged && kicked && parted == 0) parted = step;
      if (merged && parted > 0 && again == 0) again = step;
      kicked |= merged;
    });
    EXPECT_GT(parted, 0);
    EXPECT_GT(again, parted);
    return again - parted;
  };
  EXPECT_GE(stepsApart({}), 20);
  EXPECT_LT(stepsApart(kPaper), 15);
}

int wallEvents(const Scene& scene) {
  Simulation run(scene, Mode::Merge);
  run.until(5.0);
  const int before = run.count(EventType::Merge) + run.count(EventType::Unmerge);
  EXPECT_GT(before, 0);
  EXPECT_LE(run.world().stats().active_bodies, 2) << "all is merged";
  run.until(15.0);
  return run.count(EventType::Merge) + run.count(EventType::Unmerge) - before;
}

TEST(Unmerge, AWallOnTheGroundDoesNotFlicker) { EXPECT_EQ(wallEvents(wall(18, 18)), 0); }

/// Partings in the first ten seconds of a wall that merges while it sinks in.
int partingsOfASettlingWall(MergingRule merging, UnmergingRule unmerging) {
  Scene scene = wall(18, 18);
  scene.settings.merging.rule = merging;
  scene.settings.unmerging.rule = unmerging;
  Simulation run(scene, Mode::Merge);
  run.until(10.0);
  return run.count(EventType::Unmerge);
}

TEST(Unmerge, UnderThePapersRulesAWallPartsWhileItSettles) {
  EXPECT_NEAR(partingsOfASettlingWall(MergingRule::Default, UnmergingRule::Default), 8, 5);
  EXPECT_NEAR(partingsOfASettlingWall(MergingRule::Paper, UnmergingRule::Default), 150, 15);
  EXPECT_NEAR(partingsOfASettlingWall(MergingRule::Default, UnmergingRule::Paper), 188, 15);
  EXPECT_NEAR(partingsOfASettlingWall(MergingRule::Paper, UnmergingRule::Paper), 390, 30);
}

TEST(Unmerge, AWallOnASwingingPlatformDoesNotFlicker) {
  EXPECT_EQ(wallEvents(wallOnSwingingPlatform(18, 18, 0.4, 10.0)), 0);
}

// ---- release ----

/// A plank on two blocks, all merged with the ground.
const std::string kPlankOnTwo = kGround + R"(
[[body]]
name = "left"
at = [-1, 0.5]
box = [1, 1]
[[body]]
name = "right"
at = [1, 0.5]
box = [1, 1]
[[body]]
name = "plank"
at = [0, 1.1]
box = [3, 0.2]
)";

/// The other block goes; the plank stays on the one whose weld was marked, but not parted, in an
/// earlier step.
void releaseTheRightBlock(const Overrides& rule) {
  const Scene scene = parseScene(kPlankOnTwo, "test.toml", rule);
  World world(scene, {.mode = Mode::Merge, .timings = false});
  while (world.time() < 2.0) world.step();
  merge2d::Setup setup;
  setUp(scene, Mode::Merge, setup);
  restoreState(world.save(), "world", scene, setup);
  State& state = setup.state;
  Scratch scratch;
  const BodyId left = idOf(world, "left"), right = idOf(world, "right"),
               plank = idOf(world, "plank");
  const auto between = [&](const Weld& weld) { return weld.a == left && weld.b == plank; };
  ASSERT_TRUE(stillTogether(state, left, plank));
  Collection& c = state.collection(state[plank].rigid);
  const auto weld = std::ranges::find_if(c.welds, between);
  ASSERT_NE(weld, c.welds.end());
  weld->cut = true;
  weld->reason = EventReason::Sliding;
  releaseBody(state, scratch, right);
  EXPECT_FALSE(stillTogether(state, plank, right));
  EXPECT_TRUE(stillTogether(state, left, plank));
  EXPECT_EQ(state[left].rigid, state[plank].rigid);
  for (const Event& e : scratch.events) EXPECT_EQ(e.reason, EventReason::User);
  EXPECT_EQ(scratch.events.size(), 2U) << "from the ground and from the plank";
}

TEST(Unmerge, ReleasingABodyBreaksNoWeldForAMarkOfAnEarlierStep) {
  releaseTheRightBlock({});
  releaseTheRightBlock(kPaper);
}

/// The speed that the last of a row gets from a box that comes at 3 m/s, when the row has merged
/// with the ground or sleeps [m/s]. Each is `heavier` times as heavy as the one before it.
double passedAlongARow(double restitution, double heavier, Mode mode, double h) {
  constexpr int kRow = 5;
  Scene scene = onGround();
  for (int i = 0; i <= kRow; ++i) {
    BodyDesc body = box(0.5, 0.5, {i == 0 ? -3.913 : 0.501 * i, 0.25});
    body.mass = std::pow(heavier, i);
    body.restitution = restitution;
    body.friction = i == 0 ? 0.0 : 0.01;
    body.velocity.x() = i == 0 ? 3.0 : 0.0;
    add(scene, body);
  }
  scene.bodies[0].friction = 0.01;
  scene.step = h;
  World world(scene, inMode(mode));
  double fastest = 0.0;
  while (world.time() < 2.0) {
    world.step();
    fastest = std::max(fastest, see(world, BodyId{kRow + 1}).v.x());
  }
  return fastest;
}

/// Each passes on (1 + e) m₁ / (m₁ + m₂) of its speed, or more when it is hit again: as in the
/// reference. Friction takes μ g h from each of the six in the step in which it is hit, and in the
/// one after it.
TEST(Unmerge, AllAreFreedThatABounceReaches) {
  for (const double restitution : {0.3, 0.5, 0.8, 1.0}) {
    for (const double heavier : {1.0, 0.7, 1.4}) {
      SCOPED_TRACE(::testing::Message() << "e = " << restitution << ", masses " << heavier);
      for (const double h : kStepSizes) {
        const double reference = passedAlongARow(restitution, heavier, Mode::Reference, h);
        EXPECT_GT(reference, 3.0 * std::pow((1.0 + restitution) / (1.0 + heavier), 5) - 0.1);
        for (const Mode mode : {Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
          EXPECT_NEAR(passedAlongARow(restitution, heavier, mode, h), reference,
                      12.0 * 0.01 * kGravity * h)
              << nameOf(mode) << ", h = " << h;
        }
      }
    }
  }
}

}  // namespace
}  // namespace merge2d
