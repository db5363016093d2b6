/// Drawn scenes that fall, pile up and jam.

#include <random>

#include "tests/scenes/drawn_scenes.h"

namespace merge2d {
namespace {

/// What all of them are to do: nothing blows up, nothing gets through the floor or the walls, all
/// comes to rest, and what rests is merged and asleep.
void expectComesToRest(const std::string& name, const Rows& rows) {
  const Scene scene = drawn(name, rows);
  expectNoBlowUp(scene);
  expectMergesWhatRests(scene);
  for (const Mode mode : {Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
    const SceneRun run = runDrawn(scene, mode);
    for (const BodyState& body : run.now().bodies) {
      if (!run.dynamic(body.id)) continue;
      const std::string who = name + ' ' + merge2d::name(mode) + ": " + run.nameOf(body.id);
      EXPECT_GT(body.x.y(), 0.1) << who << " is below the floor";
      EXPECT_GT(body.x.x(), 0.1) << who;
      EXPECT_LT(body.x.x(), 0.1 * static_cast<double>(rows[0].size() - 1)) << who;
      EXPECT_TRUE(!merges(mode) || body.collection != kNoCollection) << who << " is free";
      EXPECT_TRUE(!sleeps(mode) || body.asleep) << who << " is awake";
    }
  }
}

TEST(Drawn, BowlsFillUp) {
  expectComesToRest("bowls", boxed(R"(
....##...#...##.........#..##..#....
....##..###.............#..##.......
.........#...##.....##..#......##...
......##.....##.....##.....##..##...
......##..#.............#..##.......
.........###..#.......###......#....
....#.....#...##....#.....##..##....
...###...............##...##..#.....
b................b.b...............b
b................b.b...............b
bb..............bb.bb.............bb
.b..............b...b.............b.
.bb............bb...bbb.........bbb.
..bbb........bbb......bbb.....bbb...
....bbbbbbbbbb..........bbbbbbb.....
)"));
}

TEST(Drawn, LettersLieInAHeap) {
  expectComesToRest("letters", boxed(R"(
.....####..####..####..####.....
.....#..#..#..#..#.....#........
.....#..#..####..#.##..##.......
.....#..#..#..#..#..#..#........
.....####..#..#..####..####.....
................................
.#...#..####...####..#...#......
.##.##..#......#......#.#.......
.#.#.#..##.....####....#........
.#...#..#.........#...#.#.......
.#...#..####...####..#...#......
................................
..#####..#...#..###....#..#.....
....#....##..#..#..#...#..#.....
....#....#.#.#..###....####.....
....#....#..##..#.#....#..#.....
....#....#...#..#..#...#..#.....
)"));
}

TEST(Drawn, PlanksJam) {
  expectComesToRest("planks", boxed(R"(
##................
..####............
......####........
..........####....
..............####
..................
..............####
..........####....
......####........
..####............
##................
..................
##................
..####............
......####........
..........####....
..............####
)"));
}

TEST(Drawn, LinesOfOnePixelHoldEachOther) {
  expectComesToRest("lines", boxed(R"(
...####################.......#...
..............................#...
...#.......#......#...........#...
...#......#........#..........#...
...#.....#..........#.............
...#....#............#..#.........
...#...#..............#.#.........
...#..#................##.........
......................##..........
.....................#..#.........
...###################...#........
..................................
...###################............
..................................
...###################............
)"));
}

TEST(Drawn, ShapesInsideShapesStayThere) {
  const Rows rows = boxed(R"(
######################
#....................#
#..################..#
#..#..............#..#
#..#..##########..#..#
#..#..#........#..#..#
#..#..#..####..#..#..#
#..#..#..#..#..#..#..#
#..#..#..####..#..#..#
#..#..#........#..#..#
#..#..##########..#..#
#..#..............#..#
#..################..#
#....................#
######################
)");
  expectComesToRest("nested", rows);
  SceneRun run(drawn("nested", rows), Mode::Merge);
  run.steps(kDrawnSteps);
  EXPECT_EQ(run.now().stats.active_bodies, 1) << "each is merged with the one that it is in";
}

TEST(Drawn, SinglePixelsPileUp) {
  Rows rows;
  for (int row = 0; row < 24; ++row) {
    rows.push_back(row % 2 == 0 ? ".#.#.#.#.#.#.#.#." : ".................");
  }
  std::string picture;
  for (const std::string& row : rows) picture += row + '\n';
  expectComesToRest("pixels", boxed(picture));
}

/// From 28 m it arrives with 23 m/s, two pixels in a step; the floor is one pixel thick.
TEST(Drawn, APixelFromHighUpDoesNotGetThroughAThinFloor) {
  Rows rows(300, "b........................b");
  rows[2].replace(3, 1, "#");
  rows[3].replace(8, 4, "####");
  for (std::size_t row = 4; row < 9; ++row) rows[row].replace(18, 1, "#");
  rows.back() = std::string(rows[0].size(), 'b');
  expectComesToRest("high", rows);
}

/// Bodies at the picture's edge, on a slope that two cyan pixels span beyond it.
TEST(Drawn, WhatTouchesTheBorderIsAsGoodAsTheRest) {
  const Scene scene = drawn("border", rowsOf(R"(
####........######
####........######
####..............
............######
##................
##....########....
##....########....
##................
##...............#
##...............#
##...............#
.................#
.................#
..................
.................c
..................
c.................
)"));
  expectNoBlowUp(scene);
  expectMergesWhatRests(scene);
  const SceneRun run = runDrawn(scene, Mode::MergeSleep);
  EXPECT_EQ(run.now().stats.asleep, run.now().stats.bodies);
}

/// The pixels of a line.
std::vector<std::pair<int, int>> pixelsOf(int x, int y, int dx, int dy) {
  const int length = std::max({std::abs(dx), std::abs(dy), 1});
  std::vector<std::pair<int, int>> pixels;
  for (int k = 0; k <= length; ++k) {
    pixels.emplace_back(x + (2 * dx * k + length) / (2 * length),
                        y + (2 * dy * k + length) / (2 * length));
  }
  return pixels;
}

/// Some ninety lines of one pixel all over a bin, none of which touch.
Rows scatteredLines(unsigned seed) {
  constexpr int kWidth = 190, kHeight = 130;
  Rows rows(kHeight, std::string(kWidth, '.'));
  std::minstd_rand random(seed);
  const auto between = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  const auto at = [&](int x, int y) -> char& {
    return rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
  };
  const auto isFree = [&](const std::pair<int, int>& pixel) {
    for (int x = std::max(0, pixel.first - 2); x <= std::min(kWidth - 1, pixel.first + 2); ++x) {
      for (int y = std::max(0, pixel.second - 2); y <= std::min(kHeight - 1, pixel.second + 2);
           ++y) {
        if (at(x, y) != '.') return false;
      }
    }
    return true;
  };
  for (int i = 0; i < 200; ++i) {
    const int x = between(10, kWidth - 11), y = between(1, kHeight - 26);
    const int dx = between(-10, 10), dy = between(6, 24);
    const auto line = pixelsOf(x, y, dx, dy);
    if (!std::ranges::all_of(line, isFree)) continue;
    for (const auto& [px, py] : line) at(px, py) = '#';
  }
  return boxed(rows);
}

/// The scene as it is after a run that began with `start`.
Scene continued(const SceneRun& run, const Snapshot& start) {
  Scene scene = run.world().scene();
  for (const BodyState& body : run.now().bodies) {
    if (!run.dynamic(body.id)) continue;
    BodyDesc& now = scene.bodies[index(body.id)];
    const BodyState& first = start.bodies[index(body.id)];
    const Vec2 center = Pose::at(now.at, now.angle).toLocal(first.x);
    now.angle += body.angle - first.angle;
    now.at = body.x - Pose::at(Vec2::Zero(), now.angle) * center;
    now.velocity = body.v;
    now.spin = body.omega;
  }
  return scene;
}

/// The largest kinetic energy in the last 5 s of so many steps [J].
double lateEnergy(SceneRun run, int steps) {
  run.steps(steps - 500);
  double energy = 0.0;
  for (int i = 0; i < 500; ++i) {
    run.steps(1);
    energy = std::max(energy, run.now().stats.kinetic_energy);
  }
  return energy;
}

/// Lines fall into a heap and jam. Only what would not rest in the reference, gone on with from the
/// same places, may still come apart then.
TEST(LongDrawn, WhatComesApartLateWouldNotRestInTheReferenceEither) {
  constexpr double kRest = 1e-9;  // J
  int at_rest = 0;
  for (const unsigned seed : {3u, 5u, 8u}) {
    for (const double friction : {0.35, 0.45, 0.55, 0.65}) {
      Scene scene = drawn("lines", scatteredLines(seed));
      for (BodyDesc& body : scene.bodies) body.friction = friction;
      SceneRun run(scene, Mode::Merge);
      const Snapshot start = run.now();
      run.steps(kDrawnSteps);
      const double energy =
          lateEnergy(SceneRun(continued(run, start), Mode::Reference), kDrawnSteps);
      run.steps(2 * kDrawnSteps);
      const int late = run.eventsAfter(3 * kDrawnSteps / 2);
      EXPECT_TRUE(late == 0 || energy > kRest)
          << late << " events with seed " << seed << " and friction " << friction;
      at_rest += late == 0 ? 1 : 0;
    }
  }
  EXPECT_GE(at_rest, 9) << "most heaps rest";
}

}  // namespace
}  // namespace merge2d
