/// Merging in frames: on pinned and scripted bodies, on several of them, and on platforms that
/// float.

#include <gtest/gtest.h>

#include <set>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

TEST(Merge, PairsOfDifferentFramesNeverMerge) {
  // A long box lies on the ground and on a platform that drives away below it.
  Simulation run(kGround + R"(
[[body]]
name = "platform"
motion = "scripted"
at = [6, -0.5]
box = [4, 1]
script = { velocity = [0.001, 0] }
[[body]]
name = "plank"
at = [3, 0.55]
box = [8, 0.2]
[[body]]
name = "block"
at = [0, 0.2]
box = [1, 0.4]
[[body]]
name = "step"
at = [6, 0.2]
box = [1, 0.4]
)",
                 Mode::Merge, {}, true);
  int noted = 0;
  run.steps(400, [&] {
    const Snapshot now = run.now();
    for (const CollectionView& c : now.collections) {
      if (c.anchored) continue;
      ASSERT_FALSE(std::isnan(c.x.x()));
    }
    std::set<std::pair<BodyId, BodyId>> welded;
    for (const WeldView& weld : now.welds) welded.emplace(weld.a, weld.b);
    for (const Decision& d : now.decisions) {
      if (d.criterion != "frames") continue;
      EXPECT_FALSE(welded.contains({d.a, d.b}));
      ++noted;
    }
  });
  EXPECT_GT(noted, 0);
  const Pose ground = seenFrom(run.body("ground"), run.body("block"));
  EXPECT_NEAR(ground.position.x(), 0.0, 0.05);
}

/// A disc in the groove between two blocks that are pressed together; the right one stands on a
/// platform.
std::string discInAGroove(const std::string& motion_of_platform) {
  return R"(
format = 1
[[body]]
name = "ground"
motion = "pinned"
at = [-9, -0.5]
box = [20, 1]
[[body]]
name = "platform"
box = [10, 1]
)" + motion_of_platform +
         R"(
[[body]]
name = "left"
at = [0, 0]
polygon = [[-1, 0], [1, 0], [1, 0.5], [0, 1.5], [-1, 1.5]]
[[body]]
name = "right"
at = [2, 0]
polygon = [[1, 0], [1, 1.5], [0, 1.5], [-1, 0.5], [-1, 0]]
[[body]]
name = "disc"
at = [1, 1.066]
circle = 0.4
[[force]]
body = "left"
at = [0, 0.25]
force = [4, 0]
[[force]]
body = "right"
at = [2, 0.25]
force = [-4, 0]
)";
}

/// One contact with each of two frames holds as little as one contact does, also where the blocks
/// at which they are touch each other.
TEST(Merge, ADiscBetweenTwoFramesIsHeldByNeither) {
  Simulation one(discInAGroove("motion = \"pinned\"\nat = [6, -0.5]"), Mode::Merge);
  one.until(3.0);
  EXPECT_TRUE(one.anchored("disc"));
  Simulation two(discInAGroove("motion = \"scripted\"\nscript = { keyframes = [[0, 6, -0.5, 0], "
                               "[100, 6, -0.5, 0]] }"),
                 Mode::Merge);
  two.steps(300, [&] { ASSERT_FALSE(two.merged("disc")); });
  EXPECT_TRUE(two.anchored("left"));
  EXPECT_TRUE(two.anchored("right"));
}

// ---- moving frames: three boxes on a platform, two high ----

std::string onPlatform(const std::string& script, const std::string& motion_of_boxes) {
  return R"(
format = 1
[[body]]
name = "platform"
motion = "scripted"
at = [0, -0.5]
box = [12, 1]
script = )" +
         script + R"(
[[body]]
name = "box"
at = [-1, 0.5]
box = [1, 1]
repeat = { count = [2, 2], spacing = [1.5, 1] }
)" + motion_of_boxes;
}

TEST(Merge, BoxesOnAUniformlyMovingPlatformMergeAsOnTheGround) {
  const std::int64_t still = mergeStep(onPlatform("{ velocity = [0, 0] }", ""), "box[0,1]");
  const std::int64_t moving =
      mergeStep(onPlatform("{ velocity = [3, 0] }", "velocity = [3, 0]\n"), "box[0,1]");
  ASSERT_GT(still, 0);
  EXPECT_EQ(moving, still);
}

TEST(Merge, BoxesOnASlowlyTurningPlatformMerge) {
  Simulation run(onPlatform("{ spin = 2 }", "spin = 2\n"), Mode::Merge);
  run.until(3.0);
  for (const char* name : {"box[0,0]", "box[1,0]", "box[0,1]", "box[1,1]"}) {
    EXPECT_TRUE(run.merged(name)) << name;
  }
}

TEST(Merge, BoxesInASpinningBoxMerge) {
  Simulation run(R"(
format = 1
gravity = [0, 0]
[[body]]
name = "drum"
motion = "scripted"
script = { spin = 60 }
shapes = [ { box = [9, 1], at = [0, -4] }, { box = [9, 1], at = [0, 4] },
           { box = [1, 7], at = [-4, 0] }, { box = [1, 7], at = [4, 0] } ]
[[body]]
name = "low"
at = [0, -3]
velocity = [3.141592653589793, 0]
spin = 60
box = [1, 1]
[[body]]
name = "second"
at = [0, -2]
velocity = [2.0943951023931953, 0]
spin = 60
box = [1, 1]
)",
                 Mode::Merge);
  run.until(4.0);
  EXPECT_TRUE(run.merged("low"));
  EXPECT_TRUE(run.merged("second"));
  EXPECT_EQ(run.collectionOf("low"), run.collectionOf("second"));
}

TEST(Merge, AFloatingPlatformCarriesItsBoxesAsOneCollection) {
  // A constant force carries raft and boxes, 13 kg.
  Simulation run(R"(
format = 1
[[body]]
name = "raft"
at = [0, -0.5]
box = [10, 1]
velocity = [1, 0]
[[body]]
name = "box"
at = [-1, 0.5]
box = [1, 1]
velocity = [1, 0]
repeat = { count = [3, 1], spacing = [1, 1] }
[[force]]
body = "raft"
force = [0, 127.53]
)",
                 Mode::Merge);
  run.until(2.0);
  const Snapshot now = run.now();
  ASSERT_EQ(now.collections.size(), 1u);
  const CollectionView& c = now.collections.front();
  EXPECT_FALSE(c.anchored);
  EXPECT_EQ(c.bodies.size(), 4u);
  EXPECT_NEAR(c.mass, 13.0, 1e-12);
  EXPECT_NEAR(c.v.x(), 1.0, 1e-9);
  EXPECT_NEAR(c.v.y(), 0.0, 1e-9);
}

}  // namespace
}  // namespace merge2d
