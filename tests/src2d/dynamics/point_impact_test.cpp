/// One contact point at a hit, normal and friction together.

#include "src2d/dynamics/point_impact.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "tests/support/modes_and_steps.h"
#include "tests/support/random.h"

namespace merge2d {
namespace {

TEST(PointImpact, APointThatPartsIsLeftAlone) {
  EXPECT_EQ(impactOf(PointMatrix{2, 1, 2}, 0.5, {0.1, -3}), Vec2(0, 0));
}

TEST(PointImpact, APointThatSticksComesToRest) {
  const Vec2 x = impactOf(PointMatrix{2, 0, 4}, 0.5, {-4, 2});
  EXPECT_DOUBLE_EQ(x.x(), 2.0);
  EXPECT_DOUBLE_EQ(x.y(), -0.5);
}

TEST(PointImpact, APointThatSlidesIsPushedAtTheEdgeOfTheCone) {
  const Vec2 x = impactOf(PointMatrix{2, 0, 4}, 0.5, {-4, -30});
  EXPECT_DOUBLE_EQ(x.x(), 2.0);
  EXPECT_DOUBLE_EQ(x.y(), 1.0);
}

/// Sweeps from one row to the other end at no impulse: 3/2, 0, 3/2, 0 ...
TEST(PointImpact, FrictionThatLiftsThePointOffDoesNotTakeItsPressure) {
  const Vec2 x = impactOf(PointMatrix{2, 1.5, 3}, 2.0, {-3, -30});
  EXPECT_DOUBLE_EQ(x.x(), 3.0 / (2.0 + 2.0 * 1.5));
  EXPECT_DOUBLE_EQ(x.y(), 2.0 * x.x());
}

RC_GTEST_PROP(PointImpact, ObeysSignoriniAndCoulomb, ()) {
  const double nn = uniform(0.1, 10), tt = uniform(0.1, 10);
  const double nt = uniform(-0.99, 0.99) * std::sqrt(nn * tt);
  const double mu = uniform(0, 5);
  const Vec2 q(uniform(-10, 10), uniform(-10, 10));
  const Vec2 x = impactOf(PointMatrix{nn, nt, tt}, mu, q);
  const Vec2 w = q + Vec2(nn * x.x() + nt * x.y(), nt * x.x() + tt * x.y());
  const double small = 1e-9 * (1.0 + x.norm() * (nn + tt));
  RC_ASSERT(x.x() >= 0.0);
  RC_ASSERT(w.x() >= -small);
  RC_ASSERT(x.x() * w.x() <= small * (1.0 + x.x()));
  RC_ASSERT(std::abs(x.y()) <= mu * x.x() + small);
  if (std::abs(w.y()) > small)
    RC_ASSERT(std::abs(x.y() + std::copysign(mu * x.x(), w.y())) <= small);
}

/// A stick of 2 m that leans by 60° comes down at 2 m/s and slides to either side.
TEST(PointImpact, ALeaningStickBouncesByItsRestitutionHoweverRoughTheGround) {
  for (const double slide : {-6.0, 6.0}) {
    for (const double friction : {0.0, 0.5, 1.0, 2.0}) {
      SCOPED_TRACE(testing::Message() << slide << " m/s, friction " << friction);
      Scene scene = noGravity();
      add(scene, named("ground", pinned(box(200, 1, {0, -0.5}))));
      BodyDesc stick = moving(box(2, 0.1, {0, 1.1}), {slide, -2});
      stick.angle = 60.0 * kDegree;
      stick.friction = friction;
      stick.restitution = 0.5;
      add(scene, named("stick", stick));
      scene.bodies[0].friction = friction;
      scene.bodies[0].restitution = 0.5;
      inAllModesAndSteps(scene, [](World& world) {
        const auto cornerSpeed = [&] {
          const BodyState body = see(world, "stick");
          const Vec2 arm = body.pose().rotation * Vec2(-1, -0.05);
          return body.v.y() + body.omega * arm.x();
        };
        while (cornerSpeed() < 0.0 && world.time() < 0.5) world.step();
        EXPECT_NEAR(cornerSpeed(), 1.0, 22.0 * world.scene().step);  // it turns on in that step
      });
    }
  }
}

}  // namespace
}  // namespace merge2d
