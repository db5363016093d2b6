/// Magnets grab and let go, also what is merged.

#include "tests/src2d/merging/merging_testing.h"

namespace merge2d {
namespace {

/// A magnet that hangs still and holds a container from above between 0 and 2 s.
const std::string kCrane = R"(
format = 1
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [40, 1]
[[body]]
name = "magnet"
motion = "pinned"
at = [0, 5.1]
box = [1, 0.2]
[[body]]
name = "container"
at = [0, 4.5]
box = [2, 1]
[[magnet]]
body = "magnet"
on = [[0, 2]]
)";

TEST(Magnet, HoldsWhatHangsFromIt) {
  for (const Mode mode : {Mode::Reference, Mode::MergeSleep}) {
    Simulation run(kCrane, mode);
    run.until(2.0);
    EXPECT_NEAR(run.body("container").x.y(), 4.5, 1e-3);
    EXPECT_NEAR(normalForce(run.now(), run.id("magnet"), run.id("container"), 0.01), -2 * kGravity,
                0.01);
  }
}

TEST(Magnet, MergesWithWhatHangsFromIt) {
  Simulation run(kCrane, Mode::Merge);
  run.until(1.0);
  EXPECT_TRUE(run.merged("container"));
  EXPECT_EQ(run.now().stats.contacts, 0);
}

TEST(Magnet, LetsGoOfWhatItHasMergedWith) {
  for (const Mode mode : {Mode::Reference, Mode::Merge, Mode::MergeSleep}) {
    Simulation run(kCrane, mode);
    run.until(2.0);
    run.until(2.1);
    EXPECT_FALSE(run.merged("container"));
    run.until(2.5);
    // Falls freely, but for the steps in which the sum of its opening was too small to tell.
    EXPECT_NEAR(run.body("container").x.y(), 4.5 - 0.5 * kGravity * 0.25, 0.15);
    run.until(5.0);
    EXPECT_NEAR(run.body("container").x.y(), 0.5, 0.01);
  }
}

TEST(Magnet, LiftsAContainerAndPutsItDown) {
  const std::string crane = R"(
format = 1
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [40, 1]
[[body]]
name = "container"
at = [0, 0.5]
box = [2, 1]
repeat = { count = [1, 2], spacing = [0, 1] }
[[body]]
name = "magnet"
motion = "scripted"
box = [1, 0.2]
script = { keyframes = [[0, 0, 4, 0], [2, 0, 2.1, 0], [4, 0, 5, 0], [7, 6, 5, 0], [9, 6, 1.1, 0]] }
[[magnet]]
body = "magnet"
on = [[1.5, 9.5]]
)";
  for (const Mode mode : {Mode::Reference, Mode::MergeSleep}) {
    Simulation run(crane, mode);
    run.until(5.5);
    EXPECT_NEAR(run.body("container[0,1]").x.y(), 4.4, 0.02);
    EXPECT_NEAR(run.body("container[0,0]").x.y(), 0.5, 0.02);  // exactly the grabbed one
    run.until(11.0);
    EXPECT_NEAR(run.body("container[0,1]").x.x(), 6.0, 0.05);
    EXPECT_NEAR(run.body("container[0,1]").x.y(), 0.5, 0.02);
  }
}

}  // namespace
}  // namespace merge2d
