/// Blows frees what they move, and only lose what the reference loses. The solver of both sides
/// gets enough iterations to converge: with ten the reference itself moves half as many bodies
/// again.

#include <fmt/format.h>

#include "tests/support/merging_testing.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

/// Which bricks fall is chaos at each single speed: all together tell more. None may be swallowed.
TEST(Blow, BallsMoveAsManyBodiesAsInTheReference) {
  std::map<Mode, int> moved;
  for (const Vec2& velocity :
       {Vec2(9, 1), Vec2(10, 1), Vec2(12, 1), Vec2(15, 1), Vec2(20, 1), Vec2(30, 8)}) {
    const int reference = movedByBall(Mode::Reference, velocity, 100);
    EXPECT_GT(reference, 5);
    moved[Mode::Reference] += reference;
    for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
      const int now = movedByBall(mode, velocity, 100);
      EXPECT_NEAR(now, reference, std::max(4.0, 0.25 * reference))
          << velocity.x() << " m/s, " << name(mode);
      EXPECT_GE(now, 0.6 * reference) << velocity.x() << " m/s, " << name(mode);
      moved[mode] += now;
    }
  }
  for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
    EXPECT_NEAR(moved[mode], moved[Mode::Reference], 0.2 * moved[Mode::Reference]) << name(mode);
  }
}

/// A joint that carries nothing slides as one on the edge of its cone does: three such joints held
/// a row at 3 m/s to the one below, and the wall swallowed the ball.
TEST(Blow, JointsThatCarryNothingHoldNothing) {
  const int reference = movedByBall(Mode::Reference, {12.0, 1.0}, 200);
  EXPECT_NEAR(movedByBall(Mode::Merge, {12.0, 1.0}, 200), reference, 0.25 * reference);
}

/// A ball that ends a step just short of the wall has been slowed down by then, and is no new
/// contact in the next one.
TEST(Blow, IsFeltWhenItHitsTheWallInTheSecondStepOfItsContact) {
  EXPECT_EQ(movedByBall(Mode::Reference, {9.0, 1.0}, 150), 12);
  EXPECT_EQ(movedByBall(Mode::MergeSleep, {9.0, 1.0}, 150), 12);
}

/// The ball itself is counted, too.
TEST(Blow, UnderThePapersRuleABallMovesNoBrickOfAWall) {
  EXPECT_NEAR(movedByBall(Mode::Reference, {20.0, 1.0}, 150), 98, 3);
  EXPECT_NEAR(movedByBall(Mode::MergeSleep, {20.0, 1.0}, 150), 99, 3);
  EXPECT_EQ(movedByBall(Mode::MergeSleep, {20.0, 1.0}, 150, UnmergingRule::Paper), 1);
}

/// Bodies that have moved by 1 cm two seconds after one of them was struck.
int movedByKick(Scene scene, Mode mode, std::uint32_t body, const Vec2& impulse) {
  scene.settings.solver.iterations = 50;
  Simulation run(scene, mode);
  run.until(2.5);
  const Snapshot before = run.now();
  run.world().applyImpulse(BodyId{body}, before.bodies[body].x, impulse);
  run.until(4.5);
  return moved(before, run.now(), 0.01);
}

/// The same of a wall of 120.
int movedByKick(Mode mode, std::uint32_t body, const Vec2& impulse) {
  return movedByKick(wall(12, 10), mode, body, impulse);
}

/// Blow by blow, as far as chaos allows.
TEST(Blow, LiftsWhatStandsAboveASingleBrick) {
  for (const auto& [body, impulse] :
       std::map<std::uint32_t, Vec2>{{25, {-55.9, 14.9}}, {55, {-14.0, -6.7}}}) {
    const int reference = movedByKick(Mode::Reference, body, impulse);
    EXPECT_GE(reference, 10) << body;
    for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
      EXPECT_NEAR(movedByKick(mode, body, impulse), reference, 0.4 * reference)
          << name(mode) << body;
    }
  }
}

/// The sweep lifts what stands above by little between each two bricks, but by much in all.
TEST(Blow, LiftsWhatStandsAbove) {
  const std::map<std::uint32_t, Vec2> kicks{{25, {-55.9, 14.9}},
                                            {55, {-14.0, -6.7}},
                                            {79, {-45.2, -16.9}},
                                            {117, {-75.0, -56.9}},
                                            {118, {-42.7, -16.0}}};
  std::map<Mode, int> moved;
  for (const Mode mode : {Mode::Reference, Mode::Merge, Mode::MergeSleep}) {
    for (const auto& [body, impulse] : kicks) moved[mode] += movedByKick(mode, body, impulse);
  }
  EXPECT_GT(moved[Mode::Reference], 100);
  for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
    EXPECT_NEAR(moved[mode], moved[Mode::Reference], 0.2 * moved[Mode::Reference]) << name(mode);
  }
}

/// The corner of a pyramid is struck, so that all leans: no joint gives much, all together do.
TEST(Blow, CarriesOffWhatManyJointsThatGiveLittleWouldHold) {
  constexpr std::uint32_t kCorner = 6;  // of the lowest row, next to its end
  std::map<Mode, int> moved;
  for (const double impulse : {-24.0, -26.0, -28.0, -30.0, -32.0}) {
    for (const Mode mode : {Mode::Reference, Mode::Merge, Mode::MergeSleep}) {
      moved[mode] += movedByKick(pyramid(8), mode, kCorner, {impulse, 0.0});
    }
  }
  EXPECT_GT(moved[Mode::Reference], 100);
  for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
    EXPECT_NEAR(moved[mode], moved[Mode::Reference], 0.2 * moved[Mode::Reference]) << name(mode);
  }
}

/// A box on the edge of a wall that is struck hard moves as in the reference.
TEST(Blow, WhatWouldMoveGoesAtOnce) {
  std::string toml = kGround;
  for (int i = 0; i < 16; ++i) {
    toml += fmt::format("[[body]]\nname = \"b{}\"\nat = [{}, {}]\nbox = [1, 1]\n", i, i % 4 - 1.5,
                        0.5 + i / 4);
  }
  Simulation run(toml, Mode::Merge), reference(toml, Mode::Reference);
  run.until(2.0), reference.until(2.0);
  ASSERT_TRUE(run.merged("b15"));
  run.kick("b15", {3.0, 0.0}), reference.kick("b15", {3.0, 0.0});
  run.steps(1), reference.steps(1);
  EXPECT_FALSE(run.merged("b15"));
  EXPECT_TRUE(run.merged("b0"));
  run.until(3.0), reference.until(3.0);
  EXPECT_NEAR(run.body("b15").x.x(), reference.body("b15").x.x(), 0.05);
}

/// Three columns side by side, each a collection: a box is struck that pushes those beside it.
/// Of three columns side by side, the last of which is struck near its top.
TEST(Blow, ABlowGoesThroughNeighboursThatPartInTheSameStep) {
  const auto movedIn = [](Mode mode, UnmergingRule rule = UnmergingRule::Default) {
    Scene scene = onGround();
    scene.settings.unmerging.rule = rule;
    scene.settings.solver.iterations = 50;
    for (const double x : {-1.0, 0.0, 1.0}) addColumn(scene, 8, {x, 0.0});
    Simulation run(scene, mode);
    run.until(2.5);
    const Snapshot before = run.now();
    const BodyId struck{23};
    run.world().applyImpulse(struck, before.bodies[index(struck)].x, {-7.53, 3.81});
    run.until(3.0);
    return moved(before, run.now(), 0.01);
  };
  const int reference = movedIn(Mode::Reference);
  EXPECT_EQ(reference, 16);
  EXPECT_NEAR(movedIn(Mode::Merge), reference, 2);
  EXPECT_NEAR(movedIn(Mode::MergeSleep), reference, 2);
  EXPECT_EQ(movedIn(Mode::Merge, UnmergingRule::Paper), 0);
}

/// Ten boxes on the ground, `gap` apart and each merged with it, of which the first is struck.
std::string rowWithGaps(double gap, double friction) {
  return fmt::format(
      "{}[[body]]\nname = \"b\"\nat = [0, 0.5]\nbox = [1, 1]\n"
      "repeat = {{ count = [10, 1], spacing = [{}, 0] }}\n[material]\nfriction = {}\n",
      kGround, 1.0 + gap, friction);
}

/// What a blow closes only after some sweeps, it must still reach in its own step: the full solve
/// would take a box that is welded to the ground for a wall.
TEST(Blow, GoesThroughGapsInOneStep) {
  struct Case {
    double gap, blow, friction;  // m, N s
  };
  for (const auto& [gap, blow, friction] :
       {Case{0.0005, 10, 0.3}, Case{0.001, 10, 0.45}, Case{0.002, 10, 0.3}, Case{0.004, 20, 0.3},
        Case{0.0005, 10, 0.6}}) {
    const std::string toml = rowWithGaps(gap, friction);
    Simulation run(toml, Mode::Merge), reference(toml, Mode::Reference);
    run.until(2.0), reference.until(2.0);
    ASSERT_TRUE(run.merged("b[9,0]"));
    run.kick("b[0,0]", {blow, 0.0}), reference.kick("b[0,0]", {blow, 0.0});
    run.steps(3), reference.steps(3);
    const double momentum = reference.now().stats.momentum.x();
    EXPECT_NEAR(run.now().stats.momentum.x(), momentum, 0.1 * momentum) << gap << " " << blow;
    run.until(4.0), reference.until(4.0);
    const Snapshot a = run.now(), b = reference.now();
    for (std::size_t i = 0; i < a.bodies.size(); ++i) {
      EXPECT_NEAR(a.bodies[i].x.x(), b.bodies[i].x.x(), 0.05) << gap << " " << blow << " " << i;
    }
  }
}

const std::string kBoxUnderBox = kGround + R"(
[[body]]
name = "box"
at = [0, 0.5]
box = [1, 1]
[[body]]
name = "top"
at = [0.3, 1.5]
box = [1, 1]
)";

/// Knocks the lower box sideways [N s], two times a second.
void knock(Simulation& run, double impulse, int times) {
  for (int i = 0; i < times; ++i) {
    run.kick("box", {impulse, 0.0});
    run.steps(50);
  }
}

Simulation atRest(Mode mode, const Overrides& overrides = {}) {
  Simulation run(kBoxUnderBox, mode, overrides);
  run.until(1.0);
  return run;
}

double way(const Simulation& run) { return run.body("box").x.x(); }

TEST(Blow, ManySmallOnesMoveABoxAsFar) {
  Simulation reference = atRest(Mode::Reference), run = atRest(Mode::Merge);
  knock(reference, 0.35, 20);
  knock(run, 0.35, 20);
  EXPECT_GE(run.count(EventType::Unmerge), 20) << "at each knock";
  EXPECT_GT(way(reference), 0.03);
  EXPECT_NEAR(way(run), way(reference), 0.05 * way(reference));
}

TEST(Blow, AHardOneAfterManySmallOnesIsNotHeld) {
  Simulation reference = atRest(Mode::Reference), run = atRest(Mode::Merge);
  const auto lastWay = [](Simulation& r) {
    knock(r, 0.2, 20);
    const double from = way(r);
    knock(r, 3.0, 1);
    return way(r) - from;
  };
  const double expected = lastWay(reference);
  EXPECT_GT(expected, 0.05);
  EXPECT_NEAR(lastWay(run), expected, 0.05 * expected);
}

/// A wall on a plate that the ground resists with the friction `mu`.
std::string wallOnPlate(double mu) {
  return fmt::format(R"({}friction = {}
[[body]]
name = "plate"
at = [0, 0.1]
box = [6, 0.2]
[[body]]
name = "brick"
at = [-1.5, 0.45]
box = [1, 0.5]
repeat = {{ count = [4, 4], spacing = [1, 0.5] }}
)",
                     kGround, mu * mu / 0.6);
}
constexpr double kMassOnPlate = 9.2;  // kg

/// All that a world without friction on its ground may gain is what acts on it from outside.
class OnIce : public testing::TestWithParam<Mode> {};

TEST_P(OnIce, ABlowLosesNothingToTheGroundHoweverGentle) {
  for (const double speed : {1e-5, 1e-4, 1e-3, 4e-3, 2e-2}) {
    Simulation run(wallOnPlate(0.0), GetParam());
    run.until(2.0);
    const double impulse = kMassOnPlate * speed, before = run.body("plate").x.x();
    run.kick("plate", {impulse, 0.0});
    run.until(4.0);
    EXPECT_NEAR(run.now().stats.momentum.x(), impulse, 0.01 * impulse) << speed;
    EXPECT_NEAR(run.body("plate").x.x() - before, 2.0 * speed, 0.02 * speed) << speed;
  }
}

TEST_P(OnIce, ABallThatHitsAWallDrivesItOff) {
  Simulation run(wallOnPlate(0.0) + R"(
[[body]]
name = "ball"
at = [-6, 1.2]
circle = 0.2
mass = 0.01
velocity = [4, 0]
pinned_until = 2
friction = 0
)",
                 GetParam());
  run.until(4.0);
  EXPECT_NEAR(run.now().stats.momentum.x(), 0.04, 0.0004);
}

TEST_P(OnIce, ASlowPushMovesAWall) {
  for (const double acceleration : {1e-4, 4e-3, 1e-2}) {
    Simulation run(wallOnPlate(0.0) + fmt::format(R"(
[[force]]
body = "plate"
force = [{}, 0]
from = 2
)",
                                                  kMassOnPlate * acceleration),
                   GetParam());
    run.until(6.0);
    EXPECT_NEAR(run.body("plate").x.x(), 8.0 * acceleration, 0.08 * acceleration);
  }
}
INSTANTIATE_TEST_SUITE_P(EachMode, OnIce,
                         testing::Values(Mode::Reference, Mode::Merge, Mode::MergeSleep));

/// v² / 2μg. A step of 0.01 s takes 1 % of it off, as forces act at its end.
TEST(Blow, OnLittleFrictionAWallSlidesAsFarAsItsSpeedCarriesIt) {
  const double v = 4e-3;
  for (const double mu : {1e-4, 1e-3}) {
    for (const Mode mode : {Mode::Reference, Mode::Merge, Mode::MergeSleep}) {
      Simulation run(wallOnPlate(mu), mode);
      run.until(2.0);
      const double before = run.body("plate").x.x();
      run.kick("plate", {kMassOnPlate * v, 0.0});
      run.until(8.0);
      const double way = v * v / (2.0 * mu * 9.81);
      EXPECT_NEAR(run.body("plate").x.x() - before, way, 0.03 * way) << mu << name(mode);
    }
  }
}

}  // namespace
}  // namespace merge2d
