/// Which hits `compare` points out.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

/// Pebbles that fall by a metre, and a ball of 50 kg that falls by five.
constexpr const char* kFalling = R"(
format = 1
title = "Pebbles and a ball"
duration = 2
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [60, 1]
[[body]]
name = "pebble"
at = [3, 1.1]
circle = 0.1
mass = 0.1
repeat = { count = [12, 1], spacing = [1, 0] }
[[body]]
name = "ball"
at = [-5, 5.5]
circle = 0.5
mass = 50
)";

class CompareHits : public ProgramTest {
 protected:
  Json hitsOf(const std::string& scene) const {
    return run({"compare", scene, "--json", "--no-charts"}).json()["hits"];
  }
};

TEST_F(CompareHits, PointsOutTheHitsThatStandOut) {
  write("falling.toml", kFalling);
  const Json hits = hitsOf("falling.toml");
  ASSERT_THAT(hits, SizeIs(1)) << "not the pebbles";
  EXPECT_EQ(hits[0]["striker"], "ball");
  EXPECT_EQ(hits[0]["struck"], "ground");
  EXPECT_NEAR(hits[0]["time"].get<double>(), std::sqrt(2.0 * 5.0 / 9.81), 0.02);
  EXPECT_NEAR(hits[0]["energy"].get<double>(), 50.0 * 9.81 * 5.0, 100.0);
  EXPECT_THAT(hitsOf("dominoes"), IsEmpty()) << "each falls as the one before";
  std::string scene = kFalling;
  scene += R"(
[[body]]
name = "second"
at = [-8, 7.5]
circle = 0.5
mass = 50
)";
  write("falling.toml", scene);
  EXPECT_THAT(hitsOf("falling.toml"), SizeIs(2)) << "1.4 times as much, but at another time";
}

TEST_F(CompareHits, PointsOutEveryHitWhereThereAreFew) {
  std::string scene = kFalling;
  scene.replace(scene.find("[12, 1]"), 7, "[1, 1]");
  write("falling.toml", scene);
  const Json hits = hitsOf("falling.toml");
  ASSERT_THAT(hits, SizeIs(2));
  EXPECT_EQ(hits[0]["striker"], "pebble[0,0]") << "in the order of time";
  EXPECT_EQ(hits[1]["striker"], "ball");
  write("stack.toml", kStack);
  EXPECT_THAT(hitsOf("stack.toml"), IsEmpty());
}

/// In the world the first is faster only because of the truck on which both ride, say.
TEST_F(CompareHits, SaysWhereBothMoved) {
  const auto hitsAt = [&](double speed) {
    write("meet.toml", fmt::format(R"(
format = 1
gravity = [0, 0]
duration = 1.0
[[body]]
name = "first"
at = [0, 0]
circle = 0.5
velocity = [4, 0]
[[body]]
name = "second"
at = [2, 0]
circle = 0.5
velocity = [{}, 0]
)",
                                   speed));
    return hitsOf("meet.toml");
  };
  for (const auto& [speed, both] : {std::pair(0.0, false), {-0.3, false}, {1.0, true}}) {
    const Json hits = hitsAt(speed);
    ASSERT_THAT(hits, SizeIs(1)) << speed;
    EXPECT_EQ(hits[0]["striker"], "first") << speed;
    EXPECT_EQ(hits[0]["both_moved"], both) << speed;
    EXPECT_EQ(hits[0]["label"], both ? "first and second meet" : "first hits second");
  }
}

}  // namespace
}  // namespace merge2d
