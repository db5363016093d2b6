/// Blows frees what they move, and only lose what the reference loses. The solver of both sides
/// gets enough iterations to converge: with ten the reference itself moves half as many bodies
/// again.

#include "tests/src2d/merging/merging_testing.h"
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

}  // namespace
}  // namespace merge2d
