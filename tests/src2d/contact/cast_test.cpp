/// Contacts that are predicted ahead act only where the shapes meet, and nothing is missed.

#include "src2d/contact/cast.h"

#include <gtest/gtest.h>

#include "tests/support/modes_and_steps.h"

namespace merge2d {
namespace {

/// Runs for `seconds`; the body never feels anything but gravity, and nothing hits anything.
void expectFliesFreely(World& world, double seconds, std::string_view name) {
  const BodyId body = idOf(world, name);
  const Vec2 v0 = see(world, body).v, g = world.scene().gravity;
  const int steps = static_cast<int>(std::lround(seconds / world.scene().step));
  for (int i = 0; i < steps; ++i) {
    world.step();
    ASSERT_EQ(countEvents(world, EventType::Impact), 0) << "t = " << world.time();
  }
  const BodyState seen = see(world, body);
  EXPECT_NEAR((seen.v - v0 - world.time() * g).norm(), 0.0, 1e-9);
  EXPECT_NEAR(seen.omega, world.scene().bodies[index(body)].spin, 1e-9);
}

Scene beside(double table_edge) {
  Scene scene;
  add(scene, named("table", pinned(box(4, 0.2, {table_edge + 2.0, -0.1}))));
  return scene;
}

TEST(NearMiss, ABallFallsPastATable) {
  for (const double distance : {1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 5e-2}) {
    for (const double speed : {0.0, 10.0, 30.0}) {
      Scene scene = beside(0.0);
      add(scene, named("ball", moving(disc(0.1, {-0.1 - distance, 2}), {0, -speed})));
      SCOPED_TRACE(distance);
      inAllModesAndSteps(scene, [&](World& world) { expectFliesFreely(world, 1.0, "ball"); });
    }
  }
}

TEST(NearMiss, ABallFliesOverAnEdgeOnItsWay) {
  for (const double speed : {10.0, 30.0, 100.0}) {
    Scene scene = noGravity();
    add(scene, pinned(box(0.2, 4, {0, -2})));
    add(scene, named("ball", moving(disc(0.1, {-3, 0.102}), {speed, 0})));
    inAllModesAndSteps(scene, [&](World& world) { expectFliesFreely(world, 0.5, "ball"); });
  }
}

/// Corners sweep a circle of 0.707 m; the rod's hub is 0.72 m away from the post.
TEST(NearMiss, ASpinningBoxTurnsPastAPost) {
  Scene scene = noGravity();
  add(scene, pinned(disc(0.1, {0.82, 0})));
  BodyDesc rod = named("rod", box(1, 1, {0, 0}));
  rod.spin = 20.0;
  add(scene, rod);
  inAllModesAndSteps(scene, [&](World& world) { expectFliesFreely(world, 1.0, "rod"); });
}

/// Discs and boxes of any size and speed pass a post by a thousandth of their size, and by a fifth.
TEST(NearMiss, BodiesOfAnySizePassAPost) {
  for (const double size : {0.01, 0.1, 2.0}) {
    for (const double speed : {3.0, 40.0, 300.0}) {
      for (const double part : {0.001, 0.2}) {
        for (const BodyDesc& one :
             {disc(0.5 * size, {0, 0}), box(0.8 * size, 0.6 * size, {0, 0})}) {
          const double seconds = 40.0 * size / speed + 0.1;
          Scene scene = noGravity();
          add(scene, pinned(disc(0.7 * size, {0, (1.2 + part) * size})));
          add(scene, named("body", moving(one, {speed, 0})));
          scene.bodies[1].at.x() = -0.47 * seconds * speed;
          if (std::holds_alternative<Polygon>(one.shapes[0])) scene.bodies[1].spin = 7.0;
          SCOPED_TRACE(::testing::Message() << size << " m, " << speed << " m/s, " << part);
          inAllModesAndSteps(scene,
                             [&](World& world) { expectFliesFreely(world, seconds, "body"); });
        }
      }
    }
  }
}

/// Both move, and come to 2 mm from each other: seen from the first, the second moves along (−1,
/// 1), and passes at 0.402 m.
TEST(NearMiss, TwoBallsPassEachOther) {
  const double behind = 0.402 * std::numbers::sqrt2;
  Scene scene = noGravity();
  add(scene, named("a", moving(disc(0.2, {-5, 0}), {20, 0})));
  add(scene, named("b", moving(disc(0.2, {0, -5 - behind}), {0, 20})));
  inAllModesAndSteps(scene, [&](World& world) { expectFliesFreely(world, 0.5, "a"); });
}

TEST(NearMiss, ABoxFallsPastAnEdge) {
  Scene scene = beside(0.0);
  add(scene, named("box", box(0.5, 0.5, {-0.252, 1})));
  inAllModesAndSteps(scene, [&](World& world) { expectFliesFreely(world, 0.8, "box"); });
}

/// At each speed, and at each time in a step at which it comes to the plate.
TEST(Cast, ABulletNeverPassesAThinPlate) {
  for (const double speed : {10.0, 99.0, 300.0, 777.0, 1000.0}) {
    for (const double start : {-1.0, -1.37, -2.2}) {
      for (const BodyDesc& bullet : {disc(0.01, {start, 0.3}), box(0.03, 0.01, {start, 0.3})}) {
        Scene scene = noGravity();
        add(scene, pinned(box(0.005, 200, {0, 0})));
        add(scene, named("bullet", moving(bullet, {speed, 0.1 * speed})));
        scene.bodies[0].friction = scene.bodies[1].friction = 0.0;
        inAllModesAndSteps(scene, [&](World& world) {
          runSeconds(world, 0.3);
          EXPECT_LT(see(world, "bullet").x.x(), 0.0) << speed << " m/s from " << start;
        });
      }
    }
  }
}

/// What a contact yields at a blow is no part of the speed, but less than the 5 mm within which
/// contacts are kept.
TEST(Cast, ABulletStopsAtTheSurface) {
  for (const double speed : {10.0, 300.0, 1000.0}) {
    for (const BodyDesc& bullet : {disc(0.01, {-5.013, 0.3}), box(0.03, 0.02, {-5.013, 0.3})}) {
      Scene scene = noGravity();
      add(scene, pinned(box(0.005, 10, {0, 0})));
      add(scene, named("bullet", moving(bullet, {speed, 0})));
      const double half = std::holds_alternative<Circle>(bullet.shapes[0]) ? 0.01 : 0.015;
      inAllModesAndSteps(scene, [&](World& world) {
        runSeconds(world, 5.0 / speed + 0.2);
        EXPECT_NEAR(see(world, "bullet").x.x(), -0.0025 - half, 5e-3) << speed << " m/s";
      });
    }
  }
}

/// A plate that is free to move is carried along.
TEST(Cast, ABulletNeverPassesAFreePlate) {
  for (const double speed : {99.0, 1000.0}) {
    Scene scene = noGravity();
    add(scene, named("plate", box(0.005, 1, {0, 0})));
    add(scene, named("bullet", moving(disc(0.01, {-1.37, 0.0}), {speed, 0})));
    inAllModesAndSteps(scene, [&](World& world) {
      for (int i = 0; i < 20; ++i) {
        world.step();
        ASSERT_LT(see(world, "bullet").x.x(), see(world, "plate").x.x()) << speed;
      }
    });
  }
}

/// A frictionless hit off centre turns neither disc, and drives the other one along the line
/// between the centres, wherever in the step the hit is. Without restitution the step in which they
/// meet only brings them together, and the rest of the approach acts a step later, along a line
/// that has turned by up to v·h/(2r) = 0.1 rad.
TEST(Cast, AHitActsAlongTheLineOfTheCentresAtTheHit) {
  for (const double start : {-2.0, -2.013, -2.04}) {
    Scene scene = noGravity();
    BodyDesc a = named("a", moving(disc(0.2, {start, 0.2}), {3, 0}));
    BodyDesc b = named("b", disc(0.2, {0, 0}));
    a.friction = b.friction = 0.0;
    add(scene, a);
    add(scene, b);
    const Vec2 line = Vec2(std::sqrt(0.16 - 0.04), -0.2).normalized();
    inAllModesAndSteps(scene, [&](World& world) {
      runSeconds(world, 1.0);
      const Vec2 v = see(world, "b").v;
      EXPECT_NEAR(cross(line, v.normalized()), 0.0, 0.1);
      EXPECT_NEAR(v.norm(), 1.5 * line.x(), 0.1);
      EXPECT_NEAR(see(world, "a").omega, 0.0, 0.01);  // by an arm of up to 0.1 mm
      EXPECT_NEAR(see(world, "b").omega, 0.0, 0.01);
    });
  }
}

}  // namespace
}  // namespace merge2d
