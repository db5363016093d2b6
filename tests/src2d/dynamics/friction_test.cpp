/// Coulomb friction against closed forms.

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace merge2d {
namespace {

/// A flat block at rest on a long slope.
Scene blockOnSlope(double degrees, double mu_slope = 0.6, double mu_block = 0.6) {
  const Rotation up = Rotation::of(degrees * kDegree);
  Scene scene;
  add(scene, named("slope", pinned(box(60, 1, up * Vec2(0, -0.5)))));
  add(scene, named("block", box(1, 0.5, up * Vec2(0, 0.25))));
  for (BodyDesc& body : scene.bodies) body.angle = degrees * kDegree;
  scene.bodies[0].friction = mu_slope;
  scene.bodies[1].friction = mu_block;
  return scene;
}

/// The way that the block goes down the slope from t = 1 s to t = 4 s [m].
double wayDown(const Scene& scene) {
  World world = reference(scene);
  runSeconds(world, 1);
  const Vec2 from = see(world, "block").x;
  runSeconds(world, 3);
  return (see(world, "block").x - from).norm();
}

TEST(Friction, ABlockStaysOnASlopeJustBelowTheAngleOfFriction) {
  EXPECT_LT(wayDown(blockOnSlope(30.8)), 1e-6);
}

TEST(Friction, ABlockSlidesJustAboveTheAngleOfFriction) {
  EXPECT_GT(wayDown(blockOnSlope(31.1)), 0.05);
}

TEST(Friction, TheAngleAtWhichABlockStartsToSlideIsTheArcTangentOfMu) {
  double stays = 29.0, slides = 33.0;
  while (slides - stays > 0.01) {
    const double middle = 0.5 * (stays + slides);
    (wayDown(blockOnSlope(middle)) < 1e-3 ? stays : slides) = middle;
  }
  EXPECT_NEAR(0.5 * (stays + slides), std::atan(0.6) / kDegree, 0.1);
}

TEST(Friction, ASlidingBlockAcceleratesAsCoulombSays) {
  World world = reference(blockOnSlope(45));
  runSeconds(world, 0.5);
  const double before = see(world, "block").v.norm();
  runSeconds(world, 1);
  const double s = std::sin(45 * kDegree), c = std::cos(45 * kDegree);
  EXPECT_NEAR(see(world, "block").v.norm() - before, kGravity * (s - 0.6 * c), 1e-3);
}

TEST(Friction, ABoxThatSlidesOnTheFloorStopsAfterItsStoppingDistance) {
  Scene scene = onGround();
  add(scene, box(1, 0.5, {0, 0.25}));
  scene.bodies[1].velocity = {4, 0};
  World world = reference(scene);
  runSeconds(world, 2);
  EXPECT_NEAR(see(world, BodyId{1}).x.x(), 16.0 / (2.0 * 0.6 * kGravity), 0.03);
  EXPECT_LT(see(world, BodyId{1}).v.norm(), 1e-6);
}

/// How far a box slips on a platform that starts with the acceleration [m].
double slipOnPlatform(double acceleration) {
  const double period = 20.0, omega = 2.0 * std::numbers::pi / period;
  Scene scene;
  add(scene, named("platform", scripted(box(20, 1, {0, -0.5}),
                                        Sinusoid{.amplitude = acceleration / (omega * omega),
                                                 .period = period})));
  add(scene, named("box", box(1, 0.5, {0, 0.25})));
  World world = reference(scene);
  runSeconds(world, 0.25 * period);
  return std::abs(see(world, "box").x.x() - see(world, "platform").x.x());
}

TEST(Friction, ABoxOnAnAcceleratingPlatformSlipsExactlyWhenMuGIsExceeded) {
  const double limit = 0.6 * kGravity;
  EXPECT_LT(slipOnPlatform(limit - 0.05), 1e-4);
  EXPECT_GT(slipOnPlatform(limit + 0.05), 3e-3);
}

TEST(Friction, TwoBodiesTouchWithTheGeometricMeanOfTheirCoefficients) {
  World world = reference(blockOnSlope(0, 0.9, 0.4));
  world.step();
  ASSERT_FALSE(world.capture().contacts.empty());
  for (const ContactView& contact : world.capture().contacts) {
    EXPECT_DOUBLE_EQ(contact.mu, std::sqrt(0.9 * 0.4));
  }
  EXPECT_LT(wayDown(blockOnSlope(30.8, 0.9, 0.4)), 1e-6);
  EXPECT_GT(wayDown(blockOnSlope(31.1, 0.9, 0.4)), 0.05);
}

TEST(Friction, NothingHoldsABlockOnAFrictionlessSlope) {
  World world = reference(blockOnSlope(10, 0.0, 0.9));
  runSeconds(world, 2);
  EXPECT_NEAR(see(world, "block").v.norm(), 2.0 * kGravity * std::sin(10 * kDegree), 1e-6);
}

TEST(Friction, ItNeverLeavesTheCone) {
  World world = reference(arch(11));
  for (int i = 0; i < 100; ++i) {
    world.step();
    for (const ContactView& c : world.capture().contacts) {
      ASSERT_GE(c.lambda_n, 0.0);
      ASSERT_LE(std::abs(c.lambda_t), c.mu * c.lambda_n * (1.0 + 1e-9) + 1e-15);
    }
  }
}

TEST(Friction, ARollingDiscReachesTwoThirdsOfTheSpeedItWasThrownWith) {
  Scene scene = onGround();
  add(scene, disc(0.5, {0, 0.5}));
  scene.bodies[1].velocity = {3, 0};
  World world = reference(scene);
  runSeconds(world, 2);
  EXPECT_NEAR(see(world, BodyId{1}).v.x(), 2.0, 1e-3);
  EXPECT_NEAR(see(world, BodyId{1}).omega, -4.0, 2e-3);
}

}  // namespace
}  // namespace merge2d
