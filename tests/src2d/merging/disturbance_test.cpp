/// Which contacts count as a meeting, and which of them as an impact.

#include "tests/src2d/merging/merging_testing.h"

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

}  // namespace
}  // namespace merge2d
