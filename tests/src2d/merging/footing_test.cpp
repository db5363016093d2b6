/// What is high and lags behind its load stands or falls as one body would.

#include "src2d/merging/footing.h"

#include <fmt/format.h>

#include "tests/src2d/merging/merging_testing.h"

namespace merge2d {
namespace {

/// A wall of bricks of 1 m by 0.5 m, the rows in turn shifted by half a brick, on a body that moves
/// by `script`.
std::string bricks(const std::string& script, int columns, int rows) {
  std::string toml =
      fmt::format("format = 1\n[[body]]\nname = \"ground\"\nmotion = \"scripted\"\n{}\n", script);
  for (int row = 0; row < rows; ++row) {
    const double left = -0.5 * (columns - 1) + (columns > 1 ? 0.5 * (row % 2) : 0.0);
    toml += fmt::format(
        "[[body]]\nname = \"row{}\"\nat = [{}, {}]\nbox = [1, 0.5]\n"
        "repeat = {{ count = [{}, 1], spacing = [1, 0] }}\n",
        row, left, 0.75 + 0.5 * row, columns);
  }
  return toml;
}

std::string tilting(int columns, int rows) {
  return bricks("at = [0, 0]\nbox = [60, 1]\nscript = { spin = -1 }", columns, rows);
}

/// The ground drives off after 2 s, at first with this acceleration [m/s²].
std::string drivingOff(double acceleration, int columns, int rows) {
  const double way = acceleration * 100.0 / 6.0;  // of a smooth way of ten seconds
  return bricks(
      fmt::format(
          "box = [60, 1]\nscript = {{ keyframes = [[0, 0, 0, 0], [2, 0, 0, 0], [12, {0}, 0, "
          "0], [14, {0}, 0, 0]] }}",
          way),
      columns, rows);
}

/// When a brick of the highest row has moved by so many metres against the ground, or `end` [s].
double timeOfFall(Simulation& run, int rows, double end, double way = 0.1) {
  const std::string top = fmt::format("row{}[0,0]", rows - 1);
  const Vec2 before = seenFrom(run.body("ground"), run.body(top)).position;
  while (run.world().time() < end) {
    run.steps(1);
    const Vec2 now = seenFrom(run.body("ground"), run.body(top)).position;
    if ((now - before).norm() > way) break;
  }
  return run.world().time();
}

/// A column of 1 m by 4 m tips at arctan 1/4 = 14.04 degrees, a second each. By sweeps alone it
/// stood for two seconds more.
TEST(Footing, AColumnFallsWhenItsGroundTiltsTooFar) {
  for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
    Simulation run(tilting(1, 8), mode);
    run.until(14.0);
    EXPECT_EQ(run.count(EventType::Unmerge), 0) << name(mode);
    EXPECT_LT(timeOfFall(run, 8, 16.0), 15.3) << name(mode);
  }
}

/// 120 bricks, whose centre is 7.5 m above the ground and 1.75 m from its edge: they tip at 13.1
/// degrees. By sweeps alone they stood for ever.
TEST(Footing, ATowerFallsWhenItsGroundTiltsTooFar) {
  Simulation run(tilting(4, 30), Mode::Merge);
  run.until(2.0);
  EXPECT_EQ(timeOfFall(run, 30, 12.8), 12.8);
  const double time = timeOfFall(run, 30, 16.0);
  EXPECT_LT(time, 14.3);
}

TEST(Footing, AColumnFallsFromWhatDrivesOffTooFast) {
  for (const double acceleration : {2.8, 3.2, 3.6}) {  // it bears 2.45 m/s²
    Simulation run(drivingOff(acceleration, 1, 8), Mode::Merge);
    Simulation reference(drivingOff(acceleration, 1, 8), Mode::Reference,
                         {{"solver.iterations", "100"}});
    run.until(1.9), reference.until(1.9);
    const double time = timeOfFall(reference, 8, 6.0);
    EXPECT_LT(time, 3.5) << acceleration;
    EXPECT_NEAR(timeOfFall(run, 8, 6.0), time, 0.3) << acceleration;
  }
}

TEST(Footing, AColumnStaysOnWhatDrivesOffSlowly) {
  for (const double acceleration : {1.0, 2.0}) {
    Simulation run(drivingOff(acceleration, 1, 8), Mode::Merge);
    run.until(1.9);
    EXPECT_EQ(timeOfFall(run, 8, 6.0), 6.0) << acceleration;
    EXPECT_EQ(run.count(EventType::Unmerge), 0) << acceleration;
  }
}

/// Out there the floor pushes with 8.2 m/s², and there is no other gravity.
TEST(Footing, AColumnStandsInASpaceStation) {
  constexpr double kOmega = 30.0 * std::numbers::pi / 180.0;
  std::string toml =
      "format = 1\ngravity = [0, 0]\n[[body]]\nname = \"station\"\nmotion = \"scripted\"\n"
      "shapes = [{ box = [20, 1], at = [0, -30.5] }]\nat = [0, 0]\nscript = { spin = 30 }\n";
  for (int row = 0; row < 8; ++row) {
    const double y = -29.75 + 0.5 * row;
    toml += fmt::format(
        "[[body]]\nname = \"brick{}\"\nat = [0, {}]\nbox = [1, 0.5]\nvelocity = [{}, 0]\n"
        "spin = 30\n",
        row, y, -kOmega * y);
  }
  Simulation run(toml, Mode::Merge);
  run.until(4.0);
  EXPECT_EQ(run.collectionOf("brick0"), run.collectionOf("brick7"));
  EXPECT_EQ(run.count(EventType::Unmerge), 0);
}

}  // namespace
}  // namespace merge2d
