#include "src2d/relaxation/open_region.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "src2d/proofs/decided_settings.h"
#include "tests/src2d/relaxation/merged_testing.h"
#include "tests/support/tapped_walls.h"

namespace merge2d {
namespace {

/// Boxes of 1 kg in a row on the ground, on which they slide almost freely.
std::string longRow(int count) {
  return fmt::format(R"(
format = 1
[material]
friction = 0.05
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [2000, 1]
[[body]]
name = "box"
at = [0, 0.5]
box = [1, 1]
repeat = {{ count = [{}, 1], spacing = [1, 1] }}
)",
                     count);
}

/// A large collection that is open though nothing hits it is solved by rows that are all open in
/// the end: each of its members must begin with its own velocity, not with that of an earlier step.
TEST(OpenRegion, ATapOnWhatStandsBesideALargeWallPartsNothingOnAMovingFrame) {
  Simulation run(tappedWalls(), Mode::Merge);
  run.until(1.9);
  ASSERT_TRUE(run.merged("b[15,13]"));
  const int before = run.count(EventType::Unmerge);
  run.until(2.5);
  EXPECT_EQ(run.count(EventType::Unmerge), before);
}

/// No box of the row stands on a fixed foot: all of the impulse goes into its boxes, but for what
/// friction takes in one step.
TEST(OpenRegion, ABlowOnALongRowKeepsItsMomentum) {
  constexpr int kCount = 550;
  constexpr double kImpulse = 400.0;  // N s
  Simulation run(longRow(kCount), Mode::Merge, {{"solver.iterations", "100"}});
  run.until(1.0);
  ASSERT_TRUE(run.anchored("box[0,0]"));
  run.kick("box[0,0]", {kImpulse, 0.0});
  run.steps(1);
  double momentum = 0.0;
  const Snapshot now = run.now();
  for (int i = 0; i < kCount; ++i) {
    momentum += now.bodies[index(run.id(fmt::format("box[{},0]", i)))].v.x();
  }
  EXPECT_NEAR(momentum, kImpulse, kCount * 0.05 * 9.81 * 0.01);
}

/// A ram hits a box beside the row that has a belt, so that it never merges, and that passes the
/// blow on to the row.
constexpr int kLongRow = 550;
Simulation rowBehindABuffer() {
  return Simulation(longRow(kLongRow) + R"(
[[body]]
name = "buffer"
at = [-1, 0.5]
box = [1, 1]
surface_velocity = 1e-9
[[body]]
name = "ram"
at = [-12, 0.5]
box = [1, 1]
density = 20
friction = 0
velocity = [10, 0]
)",
                    Mode::Merge);
}

/// Momentum is lost to friction alone.
void expectTheBlowInTheRow(Simulation& run) {
  double of_row = 0.0;
  const Snapshot now = run.now();
  for (int i = 0; i < kLongRow; ++i) {
    of_row += now.bodies[index(run.id(fmt::format("box[{},0]", i)))].v.x();
  }
  const double all = of_row + run.body("buffer").v.x() + 20.0 * run.body("ram").v.x();
  EXPECT_GT(of_row, 50.0);
  EXPECT_NEAR(all, 200.0, kLongRow * 0.05 * 9.81 * 0.05);
}

TEST(OpenRegion, ABlowOnABodyThatTouchesARowMovesTheRow) {
  Simulation run = rowBehindABuffer();
  run.until(1.05);
  expectTheBlowInTheRow(run);
}

/// A knock at the far end opens the row, at first nowhere else.
TEST(OpenRegion, ABlowFromOutsideIsSeenWhereverItReachesAnOpenRow) {
  Simulation run = rowBehindABuffer();
  run.until(0.9);
  ASSERT_TRUE(run.anchored("box[0,0]"));
  while (run.world().time() < 1.05) {
    run.kick("box[500,0]", {0.0, -1e-3});
    run.steps(1);
  }
  expectTheBlowInTheRow(run);
}

/// A wall of bricks with a second one on it that is free; a disc falls on that.
std::string wallUnder(const std::string& above) {
  return kGround + R"(
[[body]]
name = "brick"
at = [0, 0.25]
box = [1, 0.5]
repeat = { count = [9, 1], spacing = [1, 1] }
[[body]]
name = "upper"
at = [0.5, 0.75]
box = [1, 0.5]
repeat = { count = [8, 1], spacing = [1, 1] }
)" + above;
}

TEST(OpenRegion, ABlowThroughAFreeBodyMovesWhatItMovesInTheReference) {
  const std::string scene = wallUnder(R"(
[[body]]
name = "post"
at = [4, 2]
box = [0.2, 2]
[[body]]
name = "ball"
at = [-4, 2.5]
circle = 0.3
velocity = [10, 2]
)");
  const auto farthest = [&](Mode mode) {
    Simulation run(scene, mode, {{"solver.iterations", "60"}});
    run.until(3.0);
    double way = 0.0;
    for (int i = 0; i < 8; ++i) {
      way = std::max(way, std::abs(run.body(fmt::format("upper[{},0]", i)).x.x() - 0.5 - i));
    }
    return way;
  };
  EXPECT_NEAR(farthest(Mode::Merge), farthest(Mode::Reference), 0.01);
}

/// The blow reaches the bricks near by; those at the far end of a wide wall stay welded.
TEST(OpenRegion, ABlowLeavesTheFarEndOfAWallInOnePiece) {
  Simulation run(wallUnder(R"(
[[body]]
name = "ball"
at = [0.5, 5]
circle = 0.3
)"),
                 Mode::Merge);
  run.until(3.0);
  EXPECT_TRUE(run.anchored("upper[7,0]"));
  EXPECT_NEAR((run.body("upper[7,0]").x - Vec2(7.5, 0.75)).norm(), 0.0, 5e-3);
  EXPECT_NEAR(run.body("upper[7,0]").v.norm(), 0.0, 1e-12);
}

/// Contacts pass the blow of each box on to the ground, so that no brick comes free, also where a
/// box falls flat on two bricks at once.
TEST(OpenRegion, BoxesThatFallFlatOnAWallPartNothing) {
  Scene scene = wall(6, 24);
  scene.settings.solver.iterations = 100;
  for (const double x : {-8.25, -3.5, 1.0, 6.6}) {
    BodyDesc drop = box(1, 1, {x, 9.0});
    drop.pinned_until = 3.0;
    add(scene, drop);
  }
  Simulation run(scene, Mode::Merge);
  run.until(3.0);
  const int before = run.count(EventType::Unmerge);
  const Snapshot start = run.now();
  run.until(6.0);
  EXPECT_EQ(run.count(EventType::Unmerge), before);
  EXPECT_EQ(moved(start, run.now(), 0.01), 4) << "the boxes";
}

/// How many members a wall opens where impulses act on the first ones.
std::size_t openedByKicks(std::size_t kicked) {
  Merged merged(wall(20, 30));
  Collection& c = merged.collection();
  EXPECT_TRUE(opensInPart(merged.state(), c));
  merged.scratch().open_start.resize(merged.state().bodies.size());
  for (std::size_t m = 0; m < kicked; ++m) {
    merged.scratch().kicks.push_back({c.members[m], merged.state().pose(c.members[m]).position});
  }
  OpenRegion region;
  beginRegion(merged.state(), merged.scratch(), c, region);
  return region.members.size();
}

TEST(OpenRegion, TakesAllMembersOnceItLeavesButASmallPartOutside) {
  constexpr std::size_t kAll = 610, kSmall = 76;
  EXPECT_EQ(openedByKicks(3), 3u);
  EXPECT_EQ(openedByKicks(kAll - kSmall - 1), kAll - kSmall - 1);
  EXPECT_EQ(openedByKicks(kAll - kSmall), kAll);
}

}  // namespace
}  // namespace merge2d
