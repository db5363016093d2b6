/// Loads that change slowly: walls, columns and frames stand and fall as statics say.

#include <fmt/format.h>

#include <algorithm>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

struct Wall {
  int columns, rows;
  double height = 0.5;  ///< of a brick, which is 1 m wide [m]
  double shift = 0.5;   ///< of every other row [m]
};

/// The bricks of a wall on a ground whose surface is at y = 0.5 m.
std::string bricks(const Wall& wall) {
  std::string toml;
  for (int row = 0; row < wall.rows; ++row) {
    const double left =
        -0.5 * (wall.columns - 1) + (wall.columns > 1 ? wall.shift * (row % 2) : 0.0);
    toml += fmt::format(
        "[[body]]\nname = \"row{}\"\nat = [{}, {}]\nbox = [1, {}]\n"
        "repeat = {{ count = [{}, 1], spacing = [1, 0] }}\n",
        row, left, 0.5 + (row + 0.5) * wall.height, wall.height, wall.columns);
  }
  return toml;
}

/// A wall on a body that moves by `script`.
std::string on(const std::string& script, const Wall& wall) {
  return fmt::format("format = 1\n[[body]]\nname = \"ground\"\nmotion = \"scripted\"\n{}\n{}",
                     script, bricks(wall));
}

/// By a degree per second, unless said.
std::string tilting(const Wall& wall, double spin = 1.0) {
  return on(fmt::format("at = [0, 0]\nbox = [60, 1]\nscript = {{ spin = {} }}", -spin), wall);
}

/// The ground drives off after 2 s, at first with this acceleration [m/s²].
std::string drivingOff(double acceleration, const Wall& wall) {
  const double way = acceleration * 100.0 / 6.0;  // of a smooth way of ten seconds
  return on(fmt::format(
                "box = [60, 1]\nscript = {{ keyframes = [[0, 0, 0, 0], [2, 0, 0, 0], [12, {0}, 0, "
                "0], [14, {0}, 0, 0]] }}",
                way),
            wall);
}

/// The places of all bricks, seen from the ground, which is the first body.
std::vector<Vec2> placesOf(const Simulation& run) {
  const Snapshot now = run.now();
  std::vector<Vec2> places;
  for (const BodyState& b : now.bodies) places.push_back(seenFrom(now.bodies[0], b).position);
  return places;
}

/// When brick `which` (the ground is 0) has moved by 10 cm against the ground, or `end` [s].
double timeOfFall(Simulation& run, std::size_t which, double end) {
  const Vec2 before = placesOf(run)[which];
  while (run.world().time() < end) {
    run.steps(1);
    if ((placesOf(run)[which] - before).norm() > 0.1) break;
  }
  return run.world().time();
}

/// The first brick of the highest row.
std::size_t highestOf(const Wall& wall) {
  const auto rows = static_cast<std::size_t>(wall.rows);
  const auto columns = static_cast<std::size_t>(wall.columns);
  return (rows - 1) * columns + 1;
}

/// When some brick has moved so far, or `end` [s].
double timeOfBreaking(Simulation& run, double end) {
  const std::vector<Vec2> before = placesOf(run);
  while (run.world().time() < end) {
    run.steps(1);
    const std::vector<Vec2> now = placesOf(run);
    for (std::size_t i = 0; i < now.size(); ++i) {
      if ((now[i] - before[i]).norm() > 0.1) return run.world().time();
    }
  }
  return end;
}

/// A column of 1 m by 4 m tips at arctan 1/4 = 14.04 degrees, a second each. By sweeps alone it
/// stood for two seconds more.
TEST(SlowLoad, AColumnFallsWhenItsGroundTiltsTooFar) {
  for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
    Simulation run(tilting({1, 8}), mode);
    run.until(14.0);
    EXPECT_EQ(run.count(EventType::Unmerge), 0) << name(mode);
    EXPECT_LT(timeOfFall(run, highestOf({1, 8}), 16.0), 15.3) << name(mode);
  }
}

/// 120 bricks, whose centre is 7.5 m above the ground and 1.75 m from its edge: they tip at 13.1
/// degrees. By sweeps alone they stood for ever.
TEST(SlowLoad, ATowerFallsWhenItsGroundTiltsTooFar) {
  Simulation run(tilting({4, 30}), Mode::Merge);
  run.until(2.0);
  EXPECT_EQ(timeOfFall(run, highestOf({4, 30}), 12.8), 12.8);
  const double time = timeOfFall(run, highestOf({4, 30}), 16.0);
  EXPECT_LT(time, 14.3);
}

/// 120 bricks. As one block they would tip at 13.1 degrees, but a wedge of bricks at the foot stays
/// behind: admissible forces carry them up to 11.8 degrees, the maximum of a linear programme with
/// three numbers for each contact point. The tower sways while it settles, and loses a brick. By
/// sweeps alone they stood for ever; the reference, whose contacts are soft, falls at 8.9.
TEST(SlowLoad, ATowerFallsNearTheLimitOfAdmissibleForces) {
  std::vector<double> angles;
  for (const double spin : {0.94, 0.98, 1.0, 1.02, 1.06}) {
    Simulation run(tilting({4, 30}, spin), Mode::Merge);
    run.until(2.0);
    angles.push_back(spin * timeOfFall(run, highestOf({4, 30}), 20.0));
  }
  std::ranges::sort(angles);
  EXPECT_NEAR(angles[2], 11.8, 1.0);
  EXPECT_GT(angles.front(), 10.0);
  EXPECT_LT(angles.back(), 14.3);
}

/// Some of its bricks stand on the edges of those below, and come off one by one on the way: that
/// does not bring it down. A converged reference with hard contacts falls at 13.05 degrees.
TEST(SlowLoad, ATowerThatLosesBricksFallsWhereItDoesInTheReference) {
  for (const double spin : {0.95, 0.98, 1.01, 1.05}) {
    Simulation run(tilting({4, 30}, spin), Mode::Merge);
    run.until(2.0);
    const double angle = spin * timeOfFall(run, highestOf({4, 30}) + 2, 16.0 / spin);
    EXPECT_NEAR(angle, 13.05, 1.5) << spin;
  }
}

/// It has borne the load of six degrees to either side often, and is asked about it more seldom;
/// not about more.
TEST(SlowLoad, WhatHasBorneSmallerTiltsFallsFromALargerOne) {
  const std::string swinging =
      "box = [60, 1]\nscript = { keyframes = [[0, 0, 0, 0], [2, 0, 0, 6], "
      "[4, 0, 0, -6], [6, 0, 0, 6], [8, 0, 0, -6], [10, 0, 0, 6], [12, 0, 0, -6], [40, 0, 0, -34]] "
      "}";
  const Wall column{1, 8};
  Simulation run(on(swinging, column), Mode::Merge);
  Simulation reference(on(swinging, column), Mode::Reference, {{"solver.iterations", "100"}});
  run.until(12.0), reference.until(12.0);
  EXPECT_EQ(run.count(EventType::Unmerge), 0);
  const double time = timeOfFall(reference, highestOf(column), 40.0);
  EXPECT_LT(time, 30.0);
  EXPECT_NEAR(timeOfFall(run, highestOf(column), 40.0), time, 1.0);
}

TEST(SlowLoad, AColumnFallsFromWhatDrivesOffTooFast) {
  for (const double acceleration : {2.8, 3.2, 3.6}) {  // it bears 2.45 m/s²
    Simulation run(drivingOff(acceleration, {1, 8}), Mode::Merge);
    Simulation reference(drivingOff(acceleration, {1, 8}), Mode::Reference,
                         {{"solver.iterations", "100"}});
    run.until(1.9), reference.until(1.9);
    const double time = timeOfFall(reference, highestOf({1, 8}), 6.0);
    EXPECT_LT(time, 3.5) << acceleration;
    EXPECT_NEAR(timeOfFall(run, highestOf({1, 8}), 6.0), time, 0.3) << acceleration;
  }
}

TEST(SlowLoad, AColumnStaysOnWhatDrivesOffSlowly) {
  for (const double acceleration : {1.0, 2.0}) {
    Simulation run(drivingOff(acceleration, {1, 8}), Mode::Merge);
    run.until(1.9);
    EXPECT_EQ(timeOfFall(run, highestOf({1, 8}), 6.0), 6.0) << acceleration;
    EXPECT_EQ(run.count(EventType::Unmerge), 0) << acceleration;
  }
}

/// Hard contacts and many sweeps: a reference that leans no further than statics allow.
const Overrides kHard{{"solver.iterations", "200"}, {"solver.compliance", "1e-5"}};

/// When a tilting wall of high friction breaks, merged and in the hard reference [s].
struct Breaking {
  double merged, reference;
};
Breaking breakingOf(const Wall& wall) {
  const std::string scene = tilting(wall) + "[material]\nfriction = 0.8\n";
  Simulation run(scene, Mode::Merge), reference(scene, Mode::Reference, kHard);
  run.until(2.0), reference.until(2.0);
  return {timeOfBreaking(run, 22.0), timeOfBreaking(reference, 20.0)};
}

/// Blocks on each other, each by its offset, width, height and density, on a ground that turns
/// through these key frames [s, m, m, degrees].
struct Block {
  double x, width, height, density = 1.0;
};
std::string blocksOn(const std::string& keyframes, const std::vector<Block>& blocks) {
  std::string toml = fmt::format(
      "format = 1\n[[body]]\nname = \"ground\"\nmotion = \"scripted\"\nbox = [30, 1]\n"
      "script = {{ keyframes = [{}] }}\n",
      keyframes);
  double foot = 0.5;
  for (const Block& block : blocks) {
    toml += fmt::format("[[body]]\nat = [{}, {}]\nbox = [{}, {}]\ndensity = {}\n", block.x,
                        foot + 0.5 * block.height, block.width, block.height, block.density);
    foot += block.height;
  }
  return toml;
}

/// Contacts bear no pull, so that what stands above a joint of the column tips over when its centre
/// of mass passes the end of that joint: the whole column first, at 14.31 degrees, to which the
/// ground has turned after 6.37 s. The highest block has then to move by 10 cm.
TEST(SlowLoad, AColumnWithAHeavyMiddleFallsWhenItsGroundTiltsTooFar) {
  const std::string scene = blocksOn("[0, 0, 0, 0], [1.5, 0, 0, 0], [9, 0, 0, -19.919968]",
                                     {{-0.026226, 0.938288, 0.4},
                                      {0.03321, 1.093152, 0.6},
                                      {0.061559, 0.931075, 1.0, 20.0},
                                      {0.025805, 0.853192, 0.4},
                                      {-0.059607, 0.98403, 1.0}});
  Simulation reference(scene, Mode::Reference, kHard);
  const double time = timeOfFall(reference, 5, 9.0);
  EXPECT_GT(time, 6.37);
  EXPECT_LT(time, 7.4);
  for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
    Simulation run(scene, mode);
    const double merged = timeOfFall(run, 5, 9.0);
    EXPECT_GT(merged, 6.37) << name(mode);
    EXPECT_NEAR(merged, time, 0.4) << name(mode);
  }
}

/// The column merges in the second before its platform turns to and fro, by more than its joints
/// bear.
TEST(SlowLoad, AColumnFallsFromAPlatformThatTurnsToAndFro) {
  const std::string scene = blocksOn(
      "[0, 0, 0, 0], [1, 0, 0, 0], [2.008971, 0, 0, 11.910475], [3.132667, 0, 0, "
      "8.771484], [4.808782, 0, 0, 6.251994], [7.307244, 0, 0, -19.156398]",
      {{-0.013205, 0.619996, 0.8},
       {0.028671, 0.619996, 0.8},
       {-0.000654, 0.619996, 0.8},
       {-0.02355, 0.619996, 0.8},
       {-0.001213, 0.619996, 0.8}});
  for (const std::size_t block : {5u, 1u}) {
    Simulation reference(scene, Mode::Reference, kHard);
    const double time = timeOfFall(reference, block, 9.0);
    EXPECT_LT(time, 2.5);
    for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
      Simulation run(scene, mode);
      EXPECT_NEAR(timeOfFall(run, block, 9.0), time, 0.1) << "block " << block << name(mode);
    }
  }
}

/// Each on its own edge, which all together would not do before 14 degrees. By sweeps alone, and as
/// one body, they stood for nine seconds more.
TEST(SlowLoad, ColumnsSideBySideFallOneAgainstTheOther) {
  const auto [merged, reference] =
      breakingOf({.columns = 3, .rows = 12, .height = 1.0, .shift = 0.0});
  EXPECT_LT(reference, 7.0);
  EXPECT_NEAR(merged, reference, 1.0);
}

/// A stair breaks out of it. By sweeps alone it stood for seven seconds more.
TEST(SlowLoad, AWallFallsInParts) {
  const auto [merged, reference] =
      breakingOf({.columns = 4, .rows = 8, .height = 1.0, .shift = 0.25});
  EXPECT_LT(reference, 17.5);
  EXPECT_NEAR(merged, reference, 2.0);
}

/// A platform on springs, which is turned ever further by forces at its ends.
std::string floating(const Wall& wall) {
  constexpr double kMass = 2000.0, kStiffness = 4905.0, kForce = 280.0;
  std::string toml = fmt::format(
      "format = 1\n[[body]]\nname = \"ground\"\nat = [0, 0]\nmass = {}\nbox = [20, 1]\n", kMass);
  for (const int side : {-1, 1}) {
    toml += fmt::format(
        "[[spring]]\nbody = \"ground\"\nanchor = [{0}, 0]\nto = [{0}, 2]\n"
        "rest_length = 0\nstiffness = {1}\ndamping = 1500\n",
        9 * side, kStiffness);
    for (int i = 0; i < 60; ++i) {
      toml +=
          fmt::format("[[force]]\nbody = \"ground\"\nat = [{}, 0]\nfrom = {}\nforce = [0, {}]\n",
                      9 * side, 3.0 + 0.5 * i, -side * kForce);
    }
  }
  return toml + bricks(wall);
}

/// It bears arctan 1/8 = 7.1 degrees. By sweeps alone it fell at twelve.
TEST(SlowLoad, AColumnFallsFromAFloatingPlatformThatTilts) {
  for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
    Simulation run(floating({1, 16}), mode);
    run.until(2.0);
    timeOfFall(run, highestOf({1, 16}), 30.0);
    const double tilt = -run.body("ground").angle * 180.0 / std::numbers::pi;
    EXPECT_GT(tilt, 7.1) << name(mode);
    EXPECT_LT(tilt, 8.5) << name(mode);
  }
}

TEST(SlowLoad, WhatItDoesNotOverturnStaysOnAFloatingPlatform) {
  Simulation run(floating({2, 4}), Mode::Merge);
  run.until(10.0);
  const int before = run.count(EventType::Unmerge);
  EXPECT_EQ(timeOfBreaking(run, 30.0), 30.0);
  EXPECT_EQ(run.count(EventType::Unmerge), before);
}

/// A row of boxes that a spring presses together, and nothing stands on anything.
TEST(SlowLoad, NothingFallsWithoutALoad) {
  Simulation run(
      "format = 1\ngravity = [0, 0]\n[[body]]\nname = \"box\"\nat = [0, 0]\nbox = [1, 1]\n"
      "repeat = { count = [20, 1], spacing = [1, 1] }\n[[spring]]\nbody = \"box[0,0]\"\n"
      "to_body = \"box[19,0]\"\nto_anchor = [0, 0]\nrest_length = 0\nstiffness = 1\n",
      Mode::Merge);
  run.steps(400);
  EXPECT_EQ(run.collectionOf("box[0,0]"), run.collectionOf("box[19,0]"));
  EXPECT_EQ(run.count(EventType::Unmerge), 0);
}

/// Each swing takes the wall a little to and fro. By sweeps alone, which lag behind a load that
/// changes all the time, it drifted off by 20 cm. With ten iterations the reference itself is 1 cm
/// off, so this one has converged.
TEST(SlowLoad, AWallSlipsOnASwingingPlatformAsInTheReference) {
  const std::string scene =
      on("box = [80, 1]\nscript = { axis = [1, 0], amplitude = 0.8, period = 4 }", {10, 10}) +
      "[material]\nfriction = 0.15\n";
  Simulation run(scene, Mode::Merge);
  Simulation reference(scene, Mode::Reference, {{"solver.iterations", "100"}});
  const std::vector<Vec2> start = placesOf(run);
  const auto slipOf = [&](const Simulation& of) {
    const std::vector<Vec2> now = placesOf(of);
    double sum = 0.0;
    for (std::size_t i = 1; i < now.size(); ++i) sum += now[i].x() - start[i].x();
    return sum / static_cast<double>(now.size() - 1);
  };
  for (double time = 1.0; time <= 20.0; time += 1.0) {
    run.until(time), reference.until(time);
    EXPECT_NEAR(slipOf(run), slipOf(reference), 0.055) << "at " << time << " s";
  }
}

/// Out there the floor pushes with 8.2 m/s², and there is no other gravity.
TEST(SlowLoad, AColumnStandsInASpaceStation) {
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

/// The column is asked when the cart sets off; a brick that is not merged yet stands beside it.
TEST(SlowLoad, ALooseBrickBesideAColumnRidesAlong) {
  const std::string cart =
      "box = [20, 1]\nscript = { keyframes = [[0, 0, 0, 0], [4, 0, 0, 0], [6, 0.3, 0, 0]] }";
  Simulation run(on(cart, {1, 8}) +
                     "[merging]\nsteps = 100\n[[emitter]]\nname = \"side\"\nbox = [1, 0.5]\n"
                     "at = [1, 0.75]\nevery = 1\ncount = 1\nstart = 3.5\n",
                 Mode::Merge);
  run.until(4.3);
  EXPECT_EQ(run.count(EventType::Unmerge), 0);
}

/// As slow as what seems to be at rest, but it gives way to nothing.
TEST(SlowLoad, ASlowRamOverturnsAColumn) {
  for (const double speed : {0.01, 0.012, 0.015}) {
    SCOPED_TRACE(speed);
    const std::string toml = kGround +
                             "[[body]]\nname = \"brick\"\nat = [0, 0.25]\nbox = [1, 0.5]\n" +
                             "repeat = { count = [1, 20], spacing = [1, 0.5] }\n" +
                             fmt::format(
                                 "[[body]]\nname = \"ram\"\nmotion = \"scripted\"\nbox = [1, 0.4]\n"
                                 "at = [{}, 7.75]\nscript = {{ velocity = [{}, 0], spin = 0 }}\n",
                                 -1.0 - 5.0 * speed, speed);
    Simulation run(toml, Mode::Merge), reference(toml, Mode::Reference);
    run.until(12.0), reference.until(12.0);
    const double below = placesOf(reference)[13].x();
    EXPECT_GT(below, 0.04);
    EXPECT_NEAR(placesOf(run)[13].x(), below, 0.02);
  }
}

}  // namespace
}  // namespace merge2d
