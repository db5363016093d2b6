/// Symplectic Euler against closed forms, and what collisions conserve.

#include "src2d/dynamics/integrate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>

#include "src2d/core/error.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Integrate, FreeFallFollowsTheClosedFormOfSymplecticEuler) {
  Scene scene;
  scene.gravity = {0.5, -9.81};
  BodyDesc body = box(1, 2, {3, 40});
  body.velocity = {-1.5, 7};
  add(scene, body);
  World world = reference(scene);
  const double h = scene.step;
  for (int n = 1; n <= 300; ++n) {
    world.step();
    const BodyState seen = see(world, BodyId{0});
    const Vec2 x = body.at + n * h * body.velocity + 0.5 * h * h * n * (n + 1) * scene.gravity;
    const Vec2 v = body.velocity + n * h * scene.gravity;
    ASSERT_LT((seen.x - x).norm(), 1e-12) << "after step " << n;
    ASSERT_LT((seen.v - v).norm(), 1e-12) << "after step " << n;
  }
}

TEST(Integrate, AFreeBodyTurnsAtItsSpinAboutItsCentreOfMass) {
  Scene scene = noGravity();
  BodyDesc body;  // an L: its centre of mass is not its origin
  body.at = {2, 1};
  body.shapes = {makeBox(3, 1), makeBox(1, 2, Pose::at({1, 1.5}, 0.0))};
  body.spin = 2.5;
  add(scene, body);
  World world = reference(scene);
  const Vec2 center = see(world, BodyId{0}).x;
  EXPECT_LT((center - Vec2(2 + 0.4, 1 + 0.6)).norm(), 1e-14);
  runSteps(world, 400);
  EXPECT_NEAR(see(world, BodyId{0}).angle, 4.0 * 2.5, 1e-12);
  EXPECT_EQ(see(world, BodyId{0}).omega, 2.5);
  EXPECT_EQ(see(world, BodyId{0}).x, center);
}

/// Twelve discs and boxes on a grid, thrown at each other.
Scene thrownTogether(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Scene scene = noGravity();
  for (int i = 0; i < 12; ++i) {
    const Vec2 at(1.6 * (i % 4) - 2.4, 1.6 * (i / 4) - 1.6);
    BodyDesc body = i % 2 == 0 ? box(1, 0.6 + 0.3 * uniform(random), at) : disc(0.4, at);
    body.velocity = -2.0 * at + Vec2(uniform(random), uniform(random));
    body.spin = 3.0 * uniform(random);
    body.angle = uniform(random);
    body.density = 2.0 + uniform(random);
    body.restitution = 0.5 + 0.5 * uniform(random);
    add(scene, body);
  }
  return scene;
}

/// Without regard to their signs [kg m²/s].
double sumOfAngularMomenta(const World& world) {
  double sum = 0.0;
  for (const BodyState& body : world.capture().bodies) {
    const BodyInfo& info = world.bodies()[index(body.id)];
    sum += info.mass * body.x.norm() * body.v.norm() + info.inertia * std::abs(body.omega);
  }
  return sum;
}

RC_GTEST_PROP(Integrate, CollisionsConserveMomentumAndAngularMomentumToRounding, ()) {
  World world = reference(thrownTogether(*rc::gen::arbitrary<std::uint32_t>()));
  const Stats before = world.capture().stats;
  const double size = sumOfAngularMomenta(world);  // 77 or more; the sums round at its last places
  int touched = 0;
  for (int i = 0; i < 150; ++i) {
    world.step();
    touched += world.stats().contacts;
  }
  const Stats after = world.capture().stats;
  RC_ASSERT(touched > 0);
  RC_ASSERT((after.momentum - before.momentum).norm() < 1e-11);
  RC_ASSERT(std::abs(after.angular_momentum - before.angular_momentum) < 3e-13 * size);
}

TEST(Integrate, EqualDiscsThatMeetHeadOnWithoutLossExchangeTheirVelocities) {
  Scene scene = noGravity();
  for (const double side : {-1.0, 1.0}) {
    BodyDesc body = disc(0.5, {2.003 * side, 0});
    body.velocity = {-1.0 * side + 0.4, 0};
    body.restitution = 1.0;
    add(scene, body);
  }
  World world = reference(scene);
  const double energy = world.capture().stats.kinetic_energy;
  runSteps(world, 400);
  EXPECT_NEAR(see(world, BodyId{0}).v.x(), -0.6, 1e-12);
  EXPECT_NEAR(see(world, BodyId{1}).v.x(), 1.4, 1e-12);
  EXPECT_NEAR(world.capture().stats.kinetic_energy, energy, 1e-12);
}

/// What they overlap by is removed at some mm/s.
TEST(Integrate, BodiesThatMeetHeadOnWithoutBounceGoOnTogether) {
  Scene scene = noGravity();
  add(scene, box(1, 1, {-2, 0}));
  add(scene, box(1, 1, {0, 0}));
  scene.bodies[0].velocity = {3, 0};
  scene.bodies[1].density = 2.0;
  World world = reference(scene);
  runSteps(world, 100);
  EXPECT_NEAR(see(world, BodyId{0}).v.x(), 1.0, 2e-3);
  EXPECT_NEAR(see(world, BodyId{1}).v.x(), 1.0, 2e-3);
}

}  // namespace
}  // namespace merge2d
