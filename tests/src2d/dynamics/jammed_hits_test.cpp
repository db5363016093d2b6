/// Hits without end: a body that fits exactly between two others bounces to and fro in no time.

#include <gtest/gtest.h>

#include "tests/support/modes_and_steps.h"

namespace merge2d {
namespace {

/// A disc of 0.6 m between the walls of a cup that are 0.6 m apart. It moves against the cup, and
/// both fall freely.
Scene discInACup(double friction, double rolling) {
  Scene scene;
  BodyDesc cup;
  cup.mass = 1.0;
  cup.shapes = {makeBox(0.8, 0.1, Pose::at({0, -0.55}, 0)),
                makeBox(0.1, 1, Pose::at({-0.35, 0}, 0)), makeBox(0.1, 1, Pose::at({0.35, 0}, 0))};
  BodyDesc ball = moving(disc(0.3, {0, 0.1}), {1, 0});
  ball.mass = 1.0;
  for (BodyDesc* body : {&cup, &ball}) {
    body->restitution = 1.0;
    body->friction = friction;
    body->rolling = rolling;
  }
  cup.spin = 1.0;
  add(scene, named("cup", cup));
  add(scene, named("ball", ball));
  return scene;
}

/// Of both bodies as they are seen from their centre of mass [J].
double innerEnergy(const World& world) {
  const Vec2 mean = 0.5 * (see(world, "cup").v + see(world, "ball").v);
  double energy = 0.0;
  for (const char* name : {"cup", "ball"}) {
    const BodyState body = see(world, name);
    const BodyInfo& info = world.bodies()[index(body.id)];
    energy += 0.5 * info.mass * (body.v - mean).squaredNorm() +
              0.5 * info.inertia * body.omega * body.omega;
  }
  return energy;
}

TEST(JammedHits, ADiscThatJustFitsFallsWithItsCup) {
  inAllModesAndSteps(discInACup(0.5, 0.0), [](World& world) {
    const double seconds = 2.0;
    const Vec2 start = 0.5 * (see(world, "cup").x + see(world, "ball").x);
    runSeconds(world, seconds);
    const Vec2 end = 0.5 * (see(world, "cup").x + see(world, "ball").x);
    const double h = world.scene().step;
    EXPECT_NEAR(end.x() - start.x(), 0.5 * seconds, 1e-6);
    EXPECT_NEAR(end.y() - start.y(), -0.5 * kGravity * seconds * (seconds + h), 1e-6);
  });
}

TEST(JammedHits, NeitherFrictionNorRollingAddsEnergy) {
  for (const double friction : {0.0, 0.3, 0.6, 2.0}) {
    for (const double rolling : {0.0, 0.02, 0.2}) {
      SCOPED_TRACE(testing::Message() << "friction " << friction << ", rolling " << rolling);
      inAllModesAndSteps(discInACup(friction, rolling), [](World& world) {
        const double most = (1.0 + 1e-9) * innerEnergy(world);
        for (int i = 0; i < 200; ++i) {
          world.step();
          ASSERT_LE(innerEnergy(world), most) << "t = " << world.time();
        }
      });
    }
  }
}

}  // namespace
}  // namespace merge2d
