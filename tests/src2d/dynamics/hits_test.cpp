/// Hits: Newton's law, pair by pair, at any step size and in every mode.

#include "src2d/dynamics/hits.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/modes_and_steps.h"

namespace merge2d {
namespace {

BodyDesc elastic(BodyDesc body, double e = 1.0) {
  body.restitution = e;
  body.friction = 0.0;
  return body;
}

/// The kinetic energy of all that responds to forces [J].
double energyOf(const World& world) {
  double energy = 0.0;
  for (const BodyState& body : world.capture().bodies) {
    const BodyInfo& info = world.bodies()[index(body.id)];
    if (info.motion != Motion::Dynamic) continue;
    energy += 0.5 * info.mass * body.v.squaredNorm() + 0.5 * info.inertia * body.omega * body.omega;
  }
  return energy;
}

/// Runs, and expects the energy never to grow by more than rounding, nor to be lost.
void expectKeepsEnergy(World& world, double seconds, double least) {
  const double before = energyOf(world);
  const int steps = static_cast<int>(std::lround(seconds / world.scene().step));
  for (int i = 0; i < steps; ++i) {
    world.step();
    ASSERT_LE(energyOf(world), (1.0 + 1e-9) * before) << "t = " << world.time();
  }
  EXPECT_GE(energyOf(world), least * before);
}

/// The approach along the line of the centres is given back, the velocity across it stays: the
/// discs are 0.4 m apart in the centres and 0.2 m off at the hit, so the line is at 30°.
TEST(Hits, AnObliqueElasticHitKeepsItsEnergy) {
  Scene scene = noGravity();
  add(scene, named("a", elastic(moving(disc(0.2, {0, 0}), {3, 0}))));
  add(scene, named("b", elastic(disc(0.2, {3, 0.2}))));
  inAllModesAndSteps(scene, [](World& world) {
    expectKeepsEnergy(world, 3.0, 1.0 - 1e-9);
    const double c = std::cos(30 * kDegree), s = std::sin(30 * kDegree);
    EXPECT_NEAR((see(world, "b").v - Vec2(3 * c * c, 3 * c * s)).norm(), 0.0, 1e-3);
    EXPECT_NEAR((see(world, "a").v - Vec2(3 * s * s, -3 * c * s)).norm(), 0.0, 1e-3);
    EXPECT_NEAR(see(world, "a").omega, 0.0, 1e-9);
  });
}

/// The object ball leaves along the line of the centres with v·cos(cut)·(1 + e)/2. The line is that
/// at a gap of 0.01 mm, by which its speed is off by 0.01 %.
TEST(Hits, ABilliardCutHasTheAngleAndTheSpeed) {
  for (const double cut : {0.0, 10.0, 30.0, 45.0, 60.0}) {
    const double r = 0.03, angle = cut * kDegree;
    Scene scene = noGravity();
    add(scene,
        named("cue", elastic(moving(disc(r, {-0.5, 2 * r * std::sin(angle)}), {2, 0}), 0.95)));
    add(scene, named("object", elastic(disc(r, {0, 0}), 0.95)));
    SCOPED_TRACE(cut);
    inAllModesAndSteps(scene, [&](World& world) {
      runSeconds(world, 0.5);
      const Vec2 v = see(world, "object").v;
      EXPECT_NEAR(v.norm(), 2.0 * std::cos(angle) * 1.95 / 2.0, 1e-3);
      EXPECT_NEAR(std::atan2(-v.y(), v.x()), angle, 1e-3);
    });
  }
}

/// However short the way of a step is against the ball, the line of the centres is that of the
/// meeting. The faster balls come as far in a step as the slower ones.
TEST(Hits, ASlowBilliardCutHasTheAngleToo) {
  const double r = 0.03, angle = 45.0 * kDegree;
  for (const double speed : {0.02, 0.05, 0.1, 0.2, 0.3}) {
    Scene scene = noGravity();
    const Vec2 start(-0.0907, 2 * r * std::sin(angle));
    add(scene, named("cue", elastic(moving(disc(r, start), {speed, 0}), 0.95)));
    add(scene, named("object", elastic(disc(r, {0, 0}), 0.95)));
    SCOPED_TRACE(speed);
    inAllModesAndSteps(scene, [&](World& world) {
      runSeconds(world, 0.2 / speed);
      const Vec2 v = see(world, "object").v;
      EXPECT_NEAR(v.norm(), speed * std::cos(angle) * 1.95 / 2.0, 1e-3 * speed);
      EXPECT_NEAR(std::atan2(-v.y(), v.x()), angle, 2e-3);
    });
  }
}

/// The tolerance is that of a line at a gap of 0.01 mm.
TEST(Hits, RestitutionIsAsGivenAtAnObliqueHit) {
  for (const double e : {0.2, 0.5, 0.8}) {
    Scene scene = noGravity();
    add(scene, named("a", elastic(moving(disc(0.2, {0, 0}), {3, 0}), e)));
    add(scene, named("b", elastic(disc(0.2, {2.02, 0.2}), e)));
    const Vec2 line(std::cos(30 * kDegree), std::sin(30 * kDegree));
    inAllModesAndSteps(scene, [&](World& world) {
      runSeconds(world, 2.0);
      const double leaves = line.dot(see(world, "b").v - see(world, "a").v);
      EXPECT_NEAR(leaves, e * 3.0 * line.x(), 1e-3);
    });
  }
}

/// 36 bodies in a box of 8 m, with random velocities of 2 m/s.
Scene gas(const BodyDesc& one, bool turning) {
  Scene scene = noGravity();
  for (const double side : {-4.5, 4.5}) {
    add(scene, elastic(pinned(box(10, 1, {0, side}))));
    add(scene, elastic(pinned(box(1, 10, {side, 0}))));
  }
  std::mt19937 random(7);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (int i = 0; i < 36; ++i) {
    BodyDesc body = elastic(one);
    const double angle = 2.0 * std::numbers::pi * uniform();
    body.at = Vec2(-3.33 + 1.33 * (i % 6), -3.33 + 1.33 * (i / 6));
    body.velocity = 2.0 * Vec2(std::cos(angle), std::sin(angle));
    body.spin = turning ? 3.0 * uniform() - 1.5 : 0.0;
    add(scene, body);
  }
  return scene;
}

TEST(Hits, AGasOfDiscsKeepsItsEnergy) {
  for (const double r : {0.15, 0.4}) {
    inAllModesAndSteps(gas(disc(r, {0, 0}), false),
                       [](World& world) { expectKeepsEnergy(world, 10.0, 0.99); });
  }
}

TEST(Hits, AGasOfBoxesKeepsItsEnergy) {
  inAllModesAndSteps(gas(box(0.4, 0.4, {0, 0}), true),
                     [](World& world) { expectKeepsEnergy(world, 10.0, 0.99); });
}

/// Friction at a hit turns bodies and takes energy; by Newton's law alone it could also give some.
TEST(Hits, FrictionAddsNoEnergyToAGasOfBoxes) {
  Scene scene = gas(box(0.6, 0.3, {0, 0}), true);
  for (BodyDesc& body : scene.bodies) body.friction = 0.8;
  inAllModesAndSteps(scene, [](World& world) { expectKeepsEnergy(world, 5.0, 0.0); });
}

/// With any gaps, also none, and on a floor, into which each sinks by a hair: only the last one
/// leaves. The tolerance is that of rounding.
TEST(Hits, OfARowOnlyTheLastOneLeaves) {
  for (const double gap : {0.0, 1e-4, 1e-3, 5e-3}) {
    for (const BodyDesc& one : {disc(0.1, {0, 0}), box(0.2, 0.2, {0, 0})}) {
      for (const bool on_floor : {false, true}) {
        Scene scene = on_floor ? Scene{} : noGravity();
        if (on_floor) add(scene, elastic(pinned(box(100, 1, {0, -0.6}))));
        for (int i = 0; i < 5; ++i) {
          BodyDesc body = elastic(one);
          body.at.x() = (0.2 + gap) * i;
          add(scene, named("ball" + std::to_string(i), body));
        }
        BodyDesc hitter = elastic(moving(one, {3, 0}));
        hitter.at.x() = -0.7;
        add(scene, named("hitter", hitter));
        SCOPED_TRACE(gap);
        inAllModesAndSteps(scene, [&](World& world) {
          runSeconds(world, 0.8);
          EXPECT_NEAR(see(world, "ball4").v.x(), 3.0, 1e-6);
          for (const char* name : {"hitter", "ball0", "ball1", "ball2", "ball3"}) {
            EXPECT_NEAR(see(world, name).v.x(), 0.0, 1e-6) << name;
          }
        });
      }
    }
  }
}

/// The hitter comes after 3 s, when boxes have merged with the rough floor under them, or sleep.
/// The friction of a step takes μ·g·h from the last one; the others keep 1 mm/s at most, since
/// their faces lean a little.
TEST(Hits, OfARowThatHasMergedWithItsFloorOnlyTheLastOneLeaves) {
  constexpr double kFriction = 0.02;
  for (const double gap : {0.0, 1e-4, 1e-3}) {
    Scene scene;
    const auto rough = [](BodyDesc body) {
      body = elastic(body);
      body.friction = kFriction;
      return body;
    };
    add(scene, rough(pinned(box(100, 1, {0, -0.6}))));
    for (int i = 0; i < 5; ++i) {
      add(scene, named("box" + std::to_string(i), rough(box(0.2, 0.2, {(0.2 + gap) * i, 0}))));
    }
    add(scene, named("hitter", elastic(moving(box(0.2, 0.2, {-9.2, 0}), {3, 0}))));
    SCOPED_TRACE(gap);
    inAllModesAndSteps(scene, [&](World& world) {
      while (see(world, "box4").v.x() < 1.0 && world.time() < 4.0) world.step();
      const double lost = kFriction * kGravity * world.scene().step;
      EXPECT_NEAR(see(world, "box4").v.x(), 3.0, 1.1 * lost);
      for (const char* name : {"hitter", "box0", "box1", "box2", "box3"}) {
        EXPECT_NEAR(see(world, name).v.x(), 0.0, 1e-3) << name;
      }
    });
  }
}

/// Two that come in together send two out.
TEST(Hits, OfARowAsManyLeaveAsCame) {
  Scene scene = noGravity();
  for (int i = 0; i < 6; ++i) {
    const double x = i < 2 ? 0.2 * i - 1.0 : 0.2 * i;
    add(scene, elastic(moving(disc(0.1, {x, 0}), {i < 2 ? 2.0 : 0.0, 0})));
  }
  inAllModesAndSteps(scene, [](World& world) {
    runSeconds(world, 1.0);
    for (std::uint32_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(see(world, BodyId{i}).v.x(), i < 4 ? 0.0 : 2.0, 1e-6) << i;
    }
  });
}

/// Newton's cradle: five balls of 1 m that touch, on strings of 4 m. The first falls from 40°, so
/// the last one rises with 2·√(g·l)·sin 20° = 4.28 m/s.
TEST(Hits, InNewtonsCradleTheLastBallAloneSwings) {
  Scene scene;
  const auto hang = [&](int i, const Vec2& at) {
    add(scene, named("c" + std::to_string(i), elastic(disc(0.5, at))));
    JointDesc string;
    string.kind = JointKind::Distance;
    string.a = scene.bodies.size() - 1;
    string.at = at;
    string.to = Vec2(i, 5);
    scene.joints.push_back(string);
  };
  hang(0, Vec2(-4 * std::sin(40 * kDegree), 5 - 4 * std::cos(40 * kDegree)));
  for (int i = 1; i < 5; ++i) hang(i, Vec2(i, 1));
  inAllModesAndSteps(scene, [](World& world) {
    double fastest_right = 0.0, fastest_left = 0.0, inner = 0.0;
    const int steps = static_cast<int>(std::lround(12.0 / world.scene().step));
    for (int i = 0; i < steps; ++i) {
      world.step();
      fastest_right = std::max(fastest_right, see(world, "c4").v.x());
      if (world.time() > 2.0) fastest_left = std::max(fastest_left, -see(world, "c0").v.x());
      for (int k = 1; k < 4; ++k) {  // a step may end while the blow goes through them
        inner = std::max(inner, (see(world, "c" + std::to_string(k)).x - Vec2(k, 1)).norm());
      }
    }
    const double right = 2.0 * std::sqrt(4.0 * kGravity) * std::sin(20 * kDegree);
    EXPECT_NEAR(fastest_right, right, 0.02 * right);  // the discrete swing
    EXPECT_NEAR(fastest_left, right, 0.02 * right);
    EXPECT_LT(inner, 0.02);
  });
}

/// A hit at 1,500 mm from the hub of a bat that turns by up to 100° in a step: ω r = 157 m/s at
/// least, as the ball slides outwards; 0.1 % for the place of the hit.
TEST(Hits, ABallMetByAFastBatGetsItsSpeed) {
  for (const double spin : {600.0, 6000.0}) {
    Scene scene = noGravity();
    SteadyMotion turn;
    turn.spin = spin * kDegree;
    add(scene, scripted(box(4, 0.02, {0, 0}), turn));
    BodyDesc ball = named("ball", disc(0.02, {0, 1.5}));
    ball.friction = 0.0;
    add(scene, ball);
    inAllModesAndSteps(scene, [&](World& world) {
      runSeconds(world, 0.6);
      EXPECT_GE(see(world, "ball").v.norm(), 0.999 * spin * kDegree * 1.5);
    });
  }
}

/// A thin bat sweeps a half disc in its first steps: it finds a ball far beside it.
TEST(Hits, ABatFindsABallAQuarterTurnAway) {
  for (const double at : {1.0, 1.7, 1.95}) {
    Scene scene = noGravity();
    SteadyMotion turn;
    turn.spin = 6000 * kDegree;
    add(scene, scripted(box(4, 0.02, {0, 0}), turn));
    BodyDesc ball = named("ball", disc(0.02, {0, at}));
    ball.friction = 0.0;
    add(scene, ball);
    inAllModesAndSteps(scene, [&](World& world) {
      runSeconds(world, 0.035);  // 210 degrees
      EXPECT_GE(see(world, "ball").v.norm(), 0.999 * turn.spin * at) << at << " m";
    });
  }
}

/// A thin bat turns by up to 75° a step: it finds a ball anywhere beside it, and gives it
/// (1 + e) times its own speed there.
TEST(Hits, ABatFindsABallAnywhereInItsSweep) {
  for (const double restitution : {0.0, 0.7, 1.0}) {
    for (const double turn : {0.3, 0.7, 1.05, 1.3}) {
      for (const double at : {0.4, 1.0, 1.7, 1.95}) {
        for (const double angle : {0.4, 0.67, 1.28, 1.57, 2.1, 2.77}) {
          inEachModeAndStep([&](Mode mode, double h) {
            Scene scene = noGravity();
            scene.step = h;
            SteadyMotion sweep;
            sweep.spin = turn / h;
            add(scene, elastic(scripted(box(4, 0.02, {0, 0}), sweep), restitution));
            const Vec2 place(at * std::cos(angle), at * std::sin(angle));
            add(scene, named("ball", elastic(disc(0.02, place), restitution)));
            World world(scene, inMode(mode));
            runSteps(world, static_cast<int>(angle / turn) + 2);
            EXPECT_GE(see(world, "ball").v.norm(), 0.99 * (1.0 + restitution) * sweep.spin * at)
                << "e = " << restitution << ", " << turn << " rad a step, " << at << " m, at "
                << angle << " rad";
          });
        }
      }
    }
  }
}

/// A steel ball of 1 cm falls 1 cm: its first bounce is right to 3 %. At 1/60 s it takes five steps
/// to rise and to fall back.
TEST(Hits, ATinyBallBounces) {
  Scene scene = onGround();
  BodyDesc ball = named("ball", disc(0.005, {0, 0.015}));
  ball.restitution = 0.9;
  add(scene, ball);
  for (const double h : {1.0 / 60.0, 1.0 / 100.0, 1.0 / 240.0, 1.0 / 1000.0}) {
    for (const Mode mode : kAllModes) {
      scene.step = h;
      World world(scene, inMode(mode));
      double highest = 0.0;
      bool rose = false;
      while (world.time() < 0.15) {
        world.step();
        const BodyState seen = see(world, "ball");
        rose |= seen.v.y() > 0.0;
        if (rose) highest = std::max(highest, seen.x.y() - 0.005);
      }
      EXPECT_NEAR(highest, 0.81 * 0.01, 0.03 * 0.81 * 0.01) << "h = " << h;
    }
  }
}

/// From a tenth of its size to twenty times it, of whatever size: h₁ = e² h₀, to 4 % where the fall
/// takes less than ten steps, else to 1 %. Slower approaches than two steps of gravity do not
/// bounce (docs/limits.md).
TEST(Hits, ABodyOfAnySizeBounces) {
  for (const double size : {1e-3, 0.01, 0.1, 10.0, 100.0}) {
    for (const double sizes : {0.1, 1.0, 20.0}) {
      for (const BodyDesc& body : {disc(0.5 * size, {0, 0}), box(size, size, {0, 0})}) {
        const double height = sizes * size, fall = std::sqrt(2.0 * height / kGravity);
        Scene scene;
        add(scene, pinned(box(100 * size, size, {0, -size})));
        add(scene, named("body", body));
        scene.bodies[1].at.y() = height;
        scene.bodies[1].restitution = 0.9;
        SCOPED_TRACE(::testing::Message() << size << " m, from " << height << " m");
        inEachModeAndStep([&](Mode mode, double h) {
          if (fall < 2.2 * h) return;
          scene.step = h;
          World world(scene, inMode(mode));
          double highest = 0.0;
          while (world.time() < 2.5 * fall) {
            world.step();
            if (world.time() > 1.2 * fall) highest = std::max(highest, see(world, "body").x.y());
          }
          const double rises = 0.81 * height, between = kGravity * h * h / 8.0;
          EXPECT_NEAR(highest, rises, between + (fall < 10.0 * h ? 0.04 : 0.01) * rises);
        });
      }
    }
  }
}

/// The ways of a step in which it was hit are those of its velocities before and after.
TEST(Hits, ABounceLosesNoTime) {
  Scene scene = noGravity();
  add(scene, elastic(pinned(box(1, 10, {-0.5, 0}))));
  add(scene, elastic(pinned(box(1, 10, {3.5, 0}))));
  add(scene, named("ball", elastic(moving(disc(0.5, {1.5, 0}), {2.7, 0}))));
  inAllModesAndSteps(scene, [](World& world) {
    runSeconds(world, 10.0);  // 27 m in a lane of 2 m: 13.5 lanes from the middle on
    const double way = 1.0 + 2.7 * world.time(), in_lane = std::fmod(way, 4.0);
    EXPECT_NEAR(see(world, "ball").x.x(), 0.5 + (in_lane < 2.0 ? in_lane : 4.0 - in_lane), 1e-3);
  });
}

}  // namespace
}  // namespace merge2d
