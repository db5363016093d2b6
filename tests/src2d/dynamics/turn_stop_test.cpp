/// Corners that come round in a step do not pass through plates.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/modes_and_steps.h"

namespace merge2d {
namespace {

const char* const kShapes[] = {
    "box = [0.03, 0.01]",
    "box = [0.5, 0.05]",
    "polygon = [[-0.05, -0.03], [0.05, -0.03], [0, 0.06]]",
    "shapes = [{ box = [0.1, 0.01] }, { box = [0.01, 0.1] }]",
};

/// A body that flies at a plate 4 m high, 1 m and a part of a step away.
std::string shot(const std::string& shape, double speed, double angle, double plate,
                 double friction, double part, double h) {
  return fmt::format(
      "gravity = [0, 0]\n[[body]]\nname = \"plate\"\nmotion = \"pinned\"\nbox = [{}, 4]\n"
      "friction = {}\n[[body]]\nname = \"shot\"\n{}\nat = [{}, 0]\nangle = {}\n"
      "velocity = [{}, 0]\nfriction = {}\n",
      plate, friction, shape, -1.0 - part * speed * h, angle, speed, friction);
}

// A tenth of what is shot here came through before ways were followed, at 30 m/s already.
TEST(TurnStop, NoCornerPassesThroughAThinPlate) {
  int tried = 0;
  for (const char* const shape : kShapes) {
    for (const double speed : {30.0, 100.0, 1000.0}) {
      for (const double angle : {0.0, 10.0, 25.0, 40.0, 70.0, 90.0}) {
        for (const double plate : {0.005, 0.02}) {
          for (const double friction : {0.0, 0.6}) {
            const double part = ++tried % 7 / 7.0;
            inEachModeAndStep([&](Mode mode, double h) {
              World world = worldOf(shot(shape, speed, angle, plate, friction, part, h), mode, h);
              runSteps(world, static_cast<int>(1.0 / (speed * h)) + 20);
              const BodyState shot = see(world, "shot");
              if (std::abs(shot.x.y()) > 1.5) return;  // it left along the plate
              EXPECT_LT(shot.x.x(), 0.0) << shape << ", " << speed << " m/s, " << angle
                                         << " degrees, plate of " << plate << ", mu " << friction;
            });
          }
        }
      }
    }
  }
}

// It spins by 3 rad a step above the ground, which stops its corners and not its fall.
TEST(TurnStop, ASpinningBoxStaysOnTheGround) {
  inEachModeAndStep([](Mode mode, double h) {
    World world = worldOf(fmt::format("[[body]]\nname = \"ground\"\nmotion = \"pinned\"\n"
                                      "at = [0, -0.01]\nbox = [400, 0.02]\n[[body]]\n"
                                      "name = \"box\"\nat = [0, 1]\nbox = [0.4, 0.1]\nspin = {}\n",
                                      3.0 / h / kDegree),
                          mode, h);
    double lowest = 1.0;
    while (world.time() < 3.0) {
      world.step();
      lowest = std::min(lowest, see(world, "box").x.y());
    }
    EXPECT_GT(lowest, 0.04);
    runSeconds(world, 60.0);
    EXPECT_LT(std::abs(see(world, "box").omega), 0.01);
  });
}

// The second ball is at rest when the step begins, and flies 5 m in the rest of it: at 100 m/s it
// passed through the third one.
TEST(TurnStop, ABallThatIsStruckHitsTheNextInItsWay) {
  for (const double speed : {20.0, 50.0, 100.0}) {
    for (const double gap : {0.1, 0.3, 0.5}) {
      for (const double part : {0.0, 0.13, 0.37, 0.61, 0.83}) {
        inEachModeAndStep([&](Mode mode, double h) {
          SCOPED_TRACE(::testing::Message() << speed << " m/s, " << gap << " m, " << part);
          const auto ball = [](const char* name, double x, double v) {
            return fmt::format(
                "[[body]]\nname = \"{}\"\ncircle = 0.1\nat = [{}, 0]\n"
                "velocity = [{}, 0]\nrestitution = 1\nfriction = 0\n",
                name, x, v);
          };
          World world = worldOf("gravity = [0, 0]\n" + ball("cue", -0.3 - part * speed * h, speed) +
                                    ball("object", 0.0, 0.0) + ball("last", 0.2 + gap, 0.0),
                                mode, h);
          for (int i = 0; i < 20; ++i) world.step();
          EXPECT_NEAR(see(world, "last").v.x(), speed, 1e-6 * speed);
          EXPECT_LT(see(world, "object").x.x(), see(world, "last").x.x());
        });
      }
    }
  }
}

// The plate follows its script after a hit as well, and takes the bullet along.
TEST(TurnStop, APlateThatComesTowardsABulletTakesItAlong) {
  for (const char* const shape : {"circle = 0.01", "box = [0.03, 0.01]"}) {
    for (const double speed : {10.0, 100.0, 400.0}) {
      for (const double plate : {-1.0, -5.0, -20.0}) {
        for (const double part : {0.0, 0.13, 0.37, 0.61, 0.83}) {
          inEachModeAndStep([&](Mode mode, double h) {
            SCOPED_TRACE(::testing::Message() << shape << ", " << speed << ", " << plate << " m/s");
            World world = worldOf(
                fmt::format("gravity = [0, 0]\n[[body]]\nname = \"plate\"\nmotion = \"scripted\"\n"
                            "box = [0.005, 4]\nscript = {{ velocity = [{}, 0] }}\n[[body]]\n"
                            "name = \"bullet\"\n{}\nat = [{}, 0.1]\nvelocity = [{}, 0]\n",
                            plate, shape, -0.02 - (2.0 + part) * h * (speed - plate), speed),
                mode, h);
            for (int i = 0; i < 20; ++i) {
              world.step();
              ASSERT_LT(see(world, "bullet").x.x(), see(world, "plate").x.x()) << "step " << i;
            }
            EXPECT_NEAR(see(world, "bullet").v.x(), plate, 0.02 * speed);
          });
        }
      }
    }
  }
}

// Nothing is in its way: it turns as far as it should.
TEST(TurnStop, ABoxThatTurnsBesideAWallKeepsItsPace) {
  inEachModeAndStep([](Mode mode, double h) {
    World world = worldOf(fmt::format("gravity = [0, 0]\n[[body]]\nname = \"wall\"\n"
                                      "motion = \"pinned\"\nat = [0.31, 0]\nbox = [0.1, 4]\n"
                                      "[[body]]\nname = \"box\"\nbox = [0.5, 0.1]\nspin = {}\n",
                                      0.7 / h / kDegree),
                          mode, h);
    for (int i = 0; i < 100; ++i) world.step();
    EXPECT_NEAR(see(world, "box").angle, 70.0, 1e-9);
  });
}

}  // namespace
}  // namespace merge2d
