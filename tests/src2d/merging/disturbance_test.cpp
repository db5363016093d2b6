/// Which contacts count as a meeting, and which of them as an impact.

#include <fmt/format.h>

#include "tests/support/merging_testing.h"
#include "tests/support/modes_and_steps.h"

namespace merge2d {
namespace {

/// In free space a bar turns about its middle, 4 m from a small box that its end runs into.
std::string barTurnsInto(const std::string& box_first, const std::string& box_last,
                         double degrees_per_second) {
  return "format = 1\ngravity = [0, 0]\n" + box_first + R"(
[[body]]
name = "bar"
at = [0, 0]
box = [10, 0.2]
spin = )" +
         std::to_string(degrees_per_second) + "\n" + box_last;
}

const std::string kBoxAtItsEnd = R"(
[[body]]
name = "box"
at = [4.5, 0.36]
box = [0.2, 0.5]
)";

bool barHits(const std::string& toml) {
  World world(parseScene(toml, "bar.toml"), {.mode = Mode::MergeSleep, .timings = false});
  for (int i = 0; i < 100; ++i) {
    world.step();
    for (const Event& e : world.events()) {
      if (e.type == EventType::Impact) return true;
    }
  }
  return false;
}

TEST(Disturbance, IsFoundWhereABodyMovesByItsTurningAlone) {
  EXPECT_TRUE(barHits(barTurnsInto(kBoxAtItsEnd, "", 6.0)));
  EXPECT_TRUE(barHits(barTurnsInto("", kBoxAtItsEnd, 6.0)));
}

TEST(Disturbance, IsNoneWhereABodyTurnsGently) {
  EXPECT_FALSE(barHits(barTurnsInto(kBoxAtItsEnd, "", 0.2)));
  EXPECT_FALSE(barHits(barTurnsInto("", kBoxAtItsEnd, 0.2)));
}

/// Three boxes of 0.2 m, which have merged with their floor, and one that comes after `seconds`.
Scene rowThatIsHit(double restitution, double speed, double seconds) {
  Scene scene;
  const auto slippery = [&](BodyDesc body) {
    body.restitution = restitution;
    body.friction = 0.02;
    return body;
  };
  add(scene, slippery(pinned(box(200, 1, {0, -0.6}))));
  for (int i = 0; i < 3; ++i) {
    add(scene, named(fmt::format("box{}", i), slippery(box(0.2, 0.2, {0.2 * i, 0}))));
  }
  const Vec2 start(-0.2 - speed * seconds, 0);
  add(scene, named("hitter", slippery(moving(box(0.2, 0.2, start), {speed, 0}))));
  scene.bodies.back().friction = 0.0;
  return scene;
}

/// A whole number of steps after the start, to rounding. The last box has the speed of the hitter,
/// or all four together have its momentum, less the friction of two steps.
TEST(Disturbance, AHitAtTheVeryEndOfAStepIsPassedOn) {
  for (const double restitution : {1.0, 0.0}) {
    for (const double speed : {0.7, 1.2, 3.0}) {
      for (const double seconds : {1.0, 1.2, 1.3, 1.5, 1.9}) {
        SCOPED_TRACE(::testing::Message()
                     << "e = " << restitution << ", " << speed << " m/s after " << seconds << " s");
        inAllModesAndSteps(rowThatIsHit(restitution, speed, seconds), [&](World& world) {
          double fastest = 0.0;
          while (world.time() < seconds + 0.1) {
            world.step();
            fastest = std::max(fastest, see(world, "box2").v.x());
          }
          const double passed = restitution > 0.0 ? speed : speed / 4.0;
          EXPECT_NEAR(fastest, passed, 2.0 * 0.02 * kGravity * world.scene().step + 1e-3);
        });
      }
    }
  }
}

}  // namespace
}  // namespace merge2d
