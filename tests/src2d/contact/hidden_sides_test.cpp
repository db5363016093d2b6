/// Seams between flush bodies, and within compounds: they stop and lift nothing.

#include "src2d/contact/hidden_sides.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/modes_and_steps.h"

namespace merge2d {
namespace {

Scene frictionless() {
  Scene scene;
  scene.settings.material.friction = 0.0;
  return scene;
}

void addSmooth(Scene& scene, BodyDesc body) {
  body.friction = 0.0;
  add(scene, std::move(body));
}

/// `n` pinned tiles of 1 m from x = 0 on, with their surface at y = 0.
Scene tiles(int n) {
  Scene scene = frictionless();
  for (int i = 0; i < n; ++i) addSmooth(scene, pinned(box(1, 1, {0.5 + i, -0.5})));
  return scene;
}

/// Two boxes of 50 m side by side, as one body.
Scene compoundFloor() {
  Scene scene = frictionless();
  BodyDesc floor;
  floor.shapes = {makeBox(50, 1, Pose::at({-25, -0.5}, 0.0)),
                  makeBox(50, 1, Pose::at({25, -0.5}, 0.0))};
  addSmooth(scene, pinned(floor));
  return scene;
}

/// Nothing changes its speed or lifts it, from the first step on, in which the floor yields.
void expectGlides(World& world, double seconds, double speed, double height) {
  constexpr double kHop = 2e-3;   // m/s: the first settling has 1.4 mm/s
  constexpr double kLift = 1e-3;  // m: the sag of the contact itself is 0.2 mm
  const BodyId body = idOf(world, "slider");
  const int steps = static_cast<int>(std::lround(seconds / world.scene().step));
  for (int i = 0; i < steps; ++i) {
    world.step();
    const BodyState seen = see(world, body);
    ASSERT_NEAR(seen.v.x(), speed, 1e-6 * std::abs(speed)) << "x = " << seen.x.x();
    ASSERT_NEAR(seen.x.y(), height, kLift) << "x = " << seen.x.x();
    ASSERT_LT(std::abs(seen.v.y()), kHop) << "x = " << seen.x.x();
  }
}

TEST(Seams, ABoxSlidesOverTiles) {
  for (const double speed : {0.5, 5.0, 40.0, -5.0}) {
    Scene scene = tiles(50);
    addSmooth(scene,
              named("slider", moving(box(0.6, 0.6, {speed > 0 ? 2.0 : 48.0, 0.3}), {speed, 0})));
    SCOPED_TRACE(speed);
    const double seconds = std::min(8.8, 44.0 / std::abs(speed));
    inAllModesAndSteps(scene, [&](World& world) { expectGlides(world, seconds, speed, 0.3); });
  }
}

TEST(Seams, ADiscSlidesOverTiles) {
  for (const double speed : {0.5, 5.0, 40.0, -5.0}) {
    Scene scene = tiles(50);
    addSmooth(scene, named("slider", moving(disc(0.3, {speed > 0 ? 2.0 : 48.0, 0.3}), {speed, 0})));
    SCOPED_TRACE(speed);
    const double seconds = std::min(8.8, 44.0 / std::abs(speed));
    inAllModesAndSteps(scene, [&](World& world) { expectGlides(world, seconds, speed, 0.3); });
  }
}

TEST(Seams, NothingTripsInsideACompound) {
  for (const double speed : {1.0, 5.0, 20.0}) {
    for (const BodyDesc& body :
         {disc(0.3, {-0.5 * speed, 0.3}), box(0.6, 0.6, {-0.5 * speed, 0.3})}) {
      Scene scene = compoundFloor();
      addSmooth(scene, named("slider", moving(body, {speed, 0})));
      SCOPED_TRACE(speed);
      inAllModesAndSteps(scene, [&](World& world) { expectGlides(world, 1.0, speed, 0.3); });
    }
  }
}

/// Two plates that meet at `x` = 0 along a side that leads down to `foot`.
std::array<Polygon, 2> meetingAt(const Vec2& foot) {
  return {Polygon{{{-50, 0}, {-50, -1}, foot, {0, 0}}}, Polygon{{{0, 0}, foot, {50, -1}, {50, 0}}}};
}

/// The side between two plates leans to either hand, in one body and between two.
TEST(Seams, NothingTripsWhereTheSideOfTheSeamLeans) {
  for (const double lean : {-3.0, -0.5, 0.5, 3.0}) {
    for (const bool one_body : {true, false}) {
      for (const double speed : {0.5, 5.0, 20.0}) {
        for (const BodyDesc& body :
             {disc(0.3, {-0.5 * speed, 0.3}), box(0.6, 0.6, {-0.5 * speed, 0.3})}) {
          Scene scene = frictionless();
          BodyDesc floor;
          for (const Polygon& plate : meetingAt({lean, -2})) {
            floor.shapes.emplace_back(plate);
            if (one_body) continue;
            addSmooth(scene, pinned(floor));
            floor = {};
          }
          if (one_body) addSmooth(scene, pinned(floor));
          addSmooth(scene, named("slider", moving(body, {speed, 0})));
          SCOPED_TRACE(::testing::Message() << lean << " m, " << speed << " m/s");
          inAllModesAndSteps(scene, [&](World& world) { expectGlides(world, 1.0, speed, 0.3); });
        }
      }
    }
  }
}

/// A compound slides as well: an L whose foot lies on the floor.
TEST(Seams, ACompoundSlidesOverTiles) {
  Scene scene = tiles(50);
  BodyDesc foot;
  foot.at = {2.0, 0.1};
  foot.shapes = {makeBox(0.5, 0.2), makeBox(0.5, 0.2, Pose::at({0.5, 0.0}, 0.0)),
                 makeBox(0.2, 0.3, Pose::at({0.1, 0.25}, 0.0))};
  addSmooth(scene, named("slider", moving(foot, {5.0, 0})));
  const double height = World(scene, inMode(Mode::Reference)).capture().bodies.back().x.y();
  inAllModesAndSteps(scene, [&](World& world) { expectGlides(world, 2.0, 5.0, height); });
}

/// As above, where another tile carries it in each step and has to find its force anew.
void expectKeepsItsSpeed(World& world, double seconds, double speed, double height) {
  constexpr double kSinks = 1e-2;  // m: four steps of free fall at 1/60 s
  const BodyId body = idOf(world, "slider");
  const int steps = static_cast<int>(std::lround(seconds / world.scene().step));
  for (int i = 0; i < steps; ++i) {
    world.step();
    const BodyState seen = see(world, body);
    ASSERT_NEAR(seen.v.x(), speed, 1e-3 * speed) << "x = " << seen.x.x();
    ASSERT_NEAR(seen.x.y(), height, kSinks) << "x = " << seen.x.x();
  }
}

/// Several tiles lie within the way of one step, and the front may stand on any place of one.
TEST(Seams, NothingTripsOnTilesShorterThanTheWayOfAStep) {
  for (const double tile : {0.15, 0.5, 1.0}) {
    for (const double speed : {16.0, 62.0, 150.0}) {
      for (const double start : {1.7, 1.93}) {
        Scene scene = frictionless();
        const double seconds = 0.2;
        const int n = static_cast<int>((start + 1.0 + speed * seconds) / tile) + 2;
        for (int i = 0; i < n; ++i) {
          addSmooth(scene, pinned(box(tile, 1, {(0.5 + i) * tile, -0.5})));
        }
        for (const BodyDesc& body : {disc(0.3, {start, 0.3}), box(0.6, 0.6, {start, 0.3})}) {
          Scene with = scene;
          addSmooth(with, named("slider", moving(body, {speed, 0})));
          SCOPED_TRACE(::testing::Message() << tile << " m, " << speed << " m/s from " << start);
          inAllModesAndSteps(
              with, [&](World& world) { expectKeepsItsSpeed(world, seconds, speed, 0.3); });
        }
      }
    }
  }
}

/// Every other triangle has but a corner at the surface.
TEST(Seams, NothingTripsOnAFloorOfTriangles) {
  for (const double speed : {0.5, 5.0, 40.0}) {
    for (const BodyDesc& body : {disc(0.3, {2, 0.3}), box(0.6, 0.6, {2, 0.3})}) {
      Scene scene = frictionless();
      for (int i = 0; i < 30; ++i) {
        BodyDesc floor;
        const double x = i;
        floor.shapes.emplace_back(Polygon{{{x, 0}, {x + 0.5, -1}, {x + 1, 0}}});
        floor.shapes.emplace_back(Polygon{{{x + 1, 0}, {x + 0.5, -1}, {x + 1.5, -1}}});
        addSmooth(scene, pinned(floor));
      }
      addSmooth(scene, named("slider", moving(body, {speed, 0})));
      SCOPED_TRACE(speed);
      const double seconds = std::min(2.0, 26.0 / speed);
      inAllModesAndSteps(scene,
                         [&](World& world) { expectKeepsItsSpeed(world, seconds, speed, 0.3); });
    }
  }
}

/// A body hangs with one leg over the edge of a table, on which it slides, and meets a block that
/// does not reach up to the table: plastic, so both go on at half the speed.
TEST(Seams, ATableHidesNothingOfWhatItIsHigherThan) {
  Scene scene = frictionless();
  addSmooth(scene, pinned(box(10, 1, {-5, -0.5})));
  addSmooth(scene, pinned(box(10, 1, {5.5, -2.0})));
  addSmooth(scene, named("block", box(1, 1, {2.5, -1.0})));
  BodyDesc hook = moving(box(2, 0.2, {-0.7, 0.1}), {2, 0});
  hook.shapes.emplace_back(makeBox(0.2, 1, Pose::at({0.9, -0.5}, 0.0)));
  hook.density = 1.0 / 0.58;
  addSmooth(scene, named("hook", hook));
  inAllModesAndSteps(scene, [](World& world) {
    runSeconds(world, 1.2);
    EXPECT_GT(see(world, "block").v.x(), 0.8);
    EXPECT_LT(see(world, "hook").v.x(), 1.2);
  });
}

/// v²/(2μg) = 4.077 m, of which the discrete friction takes v·h/2: its speed in a step is that at
/// the end. The first settling costs less than 1 mm.
TEST(Seams, ACrateGlidesFromTableToTable) {
  Scene scene;
  scene.settings.material.friction = 0.2;
  const auto rough = [&](BodyDesc body) {
    body.friction = 0.2;
    add(scene, body);
  };
  rough(pinned(box(4, 1, {-2, -0.5})));
  rough(pinned(box(10, 1, {5, -0.5})));
  rough(named("crate", moving(box(0.8, 0.8, {-3, 0.4}), {4, 0})));
  inAllModesAndSteps(scene, [](World& world) {
    while (world.time() < 3.0) {
      world.step();
      ASSERT_NEAR(see(world, "crate").x.y(), 0.4, 1e-3) << "x = " << see(world, "crate").x.x();
    }
    const double lost = 0.5 * 4.0 * world.scene().step;
    EXPECT_NEAR(see(world, "crate").x.x(), 16.0 / (2.0 * 0.2 * kGravity) - lost - 3.0, 1e-3);
  });
}

/// The surfaces of tiles that touch only to a rounding error, overlap, or leave a hair between
/// them.
TEST(Seams, ASeamNeedNotBeExact) {
  for (const double apart : {1e-12, -1e-12, 1e-3, -0.1}) {
    Scene scene = frictionless();
    addSmooth(scene, pinned(box(10, 1, {-5, -0.5})));
    addSmooth(scene, pinned(box(10, 1, {5 + apart, -0.5})));
    addSmooth(scene, named("slider", moving(box(0.6, 0.6, {-2, 0.3}), {5, 0})));
    SCOPED_TRACE(apart);
    inAllModesAndSteps(scene, [](World& world) { expectGlides(world, 0.8, 5.0, 0.3); });
  }
}

void addRough(Scene& scene, BodyDesc body) {
  body.friction = 0.3;
  add(scene, std::move(body));
}

/// `n` tiles of 1 m as heavy as told, which lie loose on the ground, with their surface at y = 0.
Scene looseTiles(int n, double mass) {
  Scene scene;
  addRough(scene, named("ground", pinned(box(200, 1, {0, -1.5}))));
  for (int i = 0; i < n; ++i) {
    BodyDesc tile = box(1, 1, {0.5 + i, -0.5});
    tile.density = mass;
    addRough(scene, tile);
  }
  return scene;
}

/// Hinges between all that are neighbours, in the middle of their sides.
void joinTiles(Scene& scene) {
  for (std::uint32_t tile = 1; tile + 1 < scene.bodies.size(); ++tile) {
    JointDesc hinge;
    hinge.a = tile;
    hinge.b = tile + 1;
    hinge.at = {tile, -0.5};
    scene.joints.push_back(hinge);
  }
}

/// A plank of 20 m slides without friction over twenty loose tiles that stand 1 mm apart; upright,
/// its long side is along its own y axis. Neighbours are not next to each other in the list.
TEST(Seams, ALongPlankFindsTheTileThatHidesTheNextOne) {
  constexpr int kTiles = 31, kStride = 17;
  constexpr double kApart = 1.001;  // m
  for (const bool upright : {false, true}) {
    Scene scene = frictionless();
    addSmooth(scene, pinned(box(200, 1, {0, -1.5})));
    for (int body = 0; body < kTiles; ++body) {
      int tile = 0;
      while (tile * kStride % kTiles != body) ++tile;
      addSmooth(scene, box(1, 1, {0.5 + kApart * tile, -0.5}));
    }
    BodyDesc plank = upright ? box(0.6, 20, {11, 0.3}) : box(20, 0.6, {11, 0.3});
    if (upright) plank.angle = 90.0 * kDegree;
    plank.density = 1.0 / 12.0;
    addSmooth(scene, named("slider", moving(plank, {5, 0})));
    SCOPED_TRACE(upright ? "upright" : "flat");
    inAllModesAndSteps(scene, [](World& world) { expectKeepsItsSpeed(world, 1.5, 5.0, 0.3); });
  }
}

/// v²/(2μg) = 4.247 m, of which the discrete friction takes up to v·h/2.
TEST(Seams, ABoxSlidesOverLooseTilesAsFarAsCoulombSays) {
  for (const double mass : {1.0, 10.0, 1000.0}) {
    for (const bool hinged : {false, true}) {
      Scene scene = looseTiles(12, mass);
      if (hinged) joinTiles(scene);
      BodyDesc slider = moving(box(0.6, 0.6, {1.5, 0.3}), {5, 0});
      slider.density = 1.0 / 0.36;
      addRough(scene, named("slider", slider));
      SCOPED_TRACE(mass);
      inAllModesAndSteps(scene, [](World& world) {
        runSeconds(world, 2.0);
        const double lost = 5.0 * world.scene().step;
        EXPECT_NEAR(see(world, "slider").x.x(), 1.5 + 25.0 / (2.0 * 0.3 * kGravity), 0.6 * lost);
        EXPECT_NEAR(see(world, "slider").x.y(), 0.3, 1e-3);
      });
    }
  }
}

/// The tiles give way by the sag of their contacts, which takes some of the disc's energy: of a
/// disc that weighs as much as a tile 0.07 % at 1/60 s.
TEST(Seams, ADiscRollsOnOverLooseTiles) {
  for (const double mass : {1.0, 10.0, 1000.0}) {
    Scene scene = looseTiles(14, mass);
    BodyDesc slider = moving(disc(0.3, {1.5, 0.3}), {5, 0});
    slider.density = 1.0 / (std::numbers::pi * 0.09);
    slider.spin = -5.0 / 0.3;
    addRough(scene, named("slider", slider));
    SCOPED_TRACE(mass);
    inAllModesAndSteps(scene, [](World& world) {
      runSeconds(world, 2.0);
      EXPECT_NEAR(see(world, "slider").v.x(), 5.0, 0.005);
      EXPECT_NEAR(see(world, "slider").x.x(), 11.5, 0.01);
    });
  }
}

/// A box of 0.6 m weighs 0.36 kg and sinks in by 0.2 mm: at a step of more it ends against it, and
/// a drop by as much lets it go on.
TEST(Seams, AStepStopsABoxAndADropDoesNot) {
  for (const double height : {1e-4, 5e-4, 1e-3, 3e-3}) {
    for (const double direction : {1.0, -1.0}) {
      Scene scene = frictionless();
      addSmooth(scene, pinned(box(10, 1, {-5, -0.5})));
      addSmooth(scene, pinned(box(10, 1, {5, -0.5 + height})));
      const double start = direction > 0 ? 0.3 : 0.3 + height;
      addSmooth(scene, named("slider",
                             moving(box(0.6, 0.6, {-2 * direction, start}), {0.5 * direction, 0})));
      SCOPED_TRACE(height * direction);
      inAllModesAndSteps(scene, [&](World& world) {
        runSeconds(world, 4.2);
        const double v = see(world, "slider").v.x();
        if (direction > 0) {
          EXPECT_LT(v, 0.25) << "a step lets nothing pass";
        } else {
          EXPECT_LT(v, -0.45);
        }
      });
    }
  }
}

/// A floor that ends at a wall hides nothing of the wall.
TEST(Seams, AWallOnAFloorStopsABoxAndADisc) {
  for (const BodyDesc& body :
       {box(0.6, 0.6, {-2, 0.3}), disc(0.3, {-2, 0.3}), disc(0.02, {-2, 0.02})}) {
    Scene scene = frictionless();
    addSmooth(scene, pinned(box(10, 1, {-5, -0.5})));
    addSmooth(scene, pinned(box(1, 4, {0.5, 1.0})));
    addSmooth(scene, named("slider", moving(body, {3, 0})));
    inAllModesAndSteps(scene, [](World& world) {
      runSeconds(world, 1.5);
      EXPECT_LT(see(world, "slider").x.x(), 1e-3);
      EXPECT_NEAR(see(world, "slider").v.norm(), 0.0, 1e-2);
    });
  }
}

/// A plank that can move carries a block whose side leans back, so that a box meets its lower
/// corner, which lies on the plank. It pushes the block on and does not enter it.
TEST(Seams, ALoosePlankHidesNothingOfTheBlocksOnIt) {
  for (const double lean : {0.0, 0.02}) {
    Scene scene = frictionless();
    addSmooth(scene, pinned(box(40, 1, {0, -1.0})));
    addSmooth(scene, box(20, 0.5, {0, -0.25}));
    BodyDesc block;
    block.shapes.emplace_back(Polygon{{{0, 0}, {1, 0}, {1, 0.6}, {lean, 0.6}}});
    block.density = 1.0 / (0.6 * (1.0 - 0.5 * lean));
    addSmooth(scene, named("block", block));
    BodyDesc slider = moving(box(0.6, 0.6, {-1.3, 0.3}), {2, 0});
    slider.density = 1.0 / 0.36;
    addSmooth(scene, named("slider", slider));
    SCOPED_TRACE(lean);
    inAllModesAndSteps(scene, [](World& world) {
      const double between = see(world, "block").x.x() + 0.3;
      for (double t = 0.0; t < 1.0; t += world.scene().step) {
        world.step();
        const BodyState ahead = see(world, "block"), behind = see(world, "slider");
        ASSERT_NEAR(ahead.v.x() + behind.v.x(), 2.0, 0.02);
        ASSERT_GT(ahead.x.x() - behind.x.x(), between - 0.03) << "they tip a little";
      }
      EXPECT_GT(see(world, "block").v.x(), 0.99);
    });
  }
}

}  // namespace
}  // namespace merge2d
