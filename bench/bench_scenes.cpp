#include "bench/bench_scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>

namespace merge2d::bench {
namespace {

constexpr double kFriction = 0.6;
constexpr double kSpacing = 1.05;  // of boxes of 1 m side by side [m]
constexpr double kSwing = 0.4;     // peak acceleration of the platform [m/s²]

Scene emptyScene(const std::string& name) {
  Scene scene;
  scene.name = name;
  scene.title = name;
  scene.step = 0.01;
  scene.settings.solver.iterations = 10;
  return scene;
}

BodyDesc box(const std::string& name, Vec2 at, double width, double height) {
  BodyDesc body;
  body.name = name;
  body.at = at;
  body.shapes = {makeBox(width, height)};
  body.friction = kFriction;
  return body;
}

BodyDesc pinnedBox(const std::string& name, Vec2 at, double width, double height,
                   double angle = 0.0) {
  BodyDesc body = box(name, at, width, height);
  body.motion = Motion::Pinned;
  body.angle = angle;
  return body;
}

void addBox(Scene& scene, Vec2 at, double width, double height) {
  scene.bodies.push_back(box(fmt::format("box[{}]", scene.bodies.size()), at, width, height));
}

/// Its surface is y = 0.
void addPlatform(Scene& scene, double width) {
  BodyDesc platform = box("platform", {0.0, -0.5}, width, 1.0);
  platform.motion = Motion::Scripted;
  const double period = kSwingSteps * scene.step;
  const double angular = 2.0 * std::numbers::pi / period;
  platform.script = Sinusoid{Vec2::UnitX(), kSwing / (angular * angular), period};
  scene.bodies.push_back(platform);
}

void addPyramid(Scene& scene, int base, double center) {
  for (int row = 0; row < base; ++row) {
    const int boxes = base - row;
    for (int i = 0; i < boxes; ++i) {
      addBox(scene, {center + kSpacing * (i - 0.5 * (boxes - 1)), row + 0.5}, 1.0, 1.0);
    }
  }
}

}  // namespace

BenchScene tower(int count) {
  Scene scene = emptyScene(fmt::format("tower-{}", count));
  const int columns = static_cast<int>(std::lround(std::sqrt(count / 2.0)));
  addPlatform(scene, columns + 4.0);

  // Rows of `columns` boxes alternate with rows shifted by half the spacing; a prefix of a row is
  // as well supported as a whole one.
  const double left = -0.5 * (kSpacing * (columns - 1) + 1.0);
  for (int row = 0; std::ssize(scene.bodies) <= count; ++row) {
    const double y = row + 0.5;
    const bool shifted = row % 2 == 1;
    if (shifted) addBox(scene, {left + 0.25, y}, 0.5, 1.0);
    for (int i = 0; i < columns - shifted; ++i) {
      addBox(scene, {left + 0.5 + kSpacing * (i + 0.5 * shifted), y}, 1.0, 1.0);
    }
    if (shifted) addBox(scene, {-left - 0.25, y}, 0.5, 1.0);
  }
  scene.bodies.resize(static_cast<std::size_t>(count) + 1);
  return {scene, Expectation::Stands};
}

BenchScene pyramid(int base) {
  Scene scene = emptyScene(fmt::format("pyramid-{}", base));
  scene.bodies.push_back(pinnedBox("ground", {0.0, -0.5}, 2.0 * base, 1.0));
  addPyramid(scene, base, 0.0);
  return {scene, Expectation::Stands};
}

BenchScene pyramids(int count) {
  constexpr int kBase = 10;
  constexpr double kApart = 1.5 * kBase;
  Scene scene = emptyScene(fmt::format("pyramids-{}", count));
  scene.bodies.push_back(pinnedBox("ground", {0.0, -0.5}, kApart * count, 1.0));
  for (int i = 0; i < count; ++i) addPyramid(scene, kBase, kApart * (i - 0.5 * (count - 1)));
  return {scene, Expectation::Stands};
}

BenchScene tumbler(int count) {
  constexpr double kSize = 0.25, kGrid = 0.4, kInside = 20.0, kWall = 1.0;  // [m]
  Scene scene = emptyScene(fmt::format("tumbler-{}", count));
  BodyDesc drum = box("drum", Vec2::Zero(), kInside + 2.0 * kWall, kWall);
  drum.shapes.clear();
  const double from_middle = 0.5 * (kInside + kWall);
  for (const double side : {-from_middle, from_middle}) {
    drum.shapes.emplace_back(makeBox(kInside + 2.0 * kWall, kWall, Pose::at({0.0, side}, 0.0)));
    drum.shapes.emplace_back(makeBox(kWall, kInside, Pose::at({side, 0.0}, 0.0)));
  }
  drum.motion = Motion::Scripted;
  SteadyMotion turning;
  turning.spin = 25.0 * std::numbers::pi / 180.0;
  drum.script = turning;
  scene.bodies.push_back(drum);
  const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
  const double first = -0.5 * kGrid * (columns - 1);
  for (int i = 0; i < count; ++i) {
    addBox(scene, {first + kGrid * (i % columns), first + kGrid * (i / columns)}, kSize, kSize);
  }
  return {scene, Expectation::Moves};
}

BenchScene funnel(int count) {
  constexpr double kSize = 0.5;
  constexpr double kGrid = 0.6;
  constexpr int kColumns = 50;
  constexpr double kOpening = 4.0;  // between the walls' lower ends [m]
  constexpr double kLength = 30.0;  // of a wall [m]
  constexpr double kSlope = std::numbers::pi / 4.0;

  Scene scene = emptyScene(fmt::format("funnel-{}", count));
  scene.bodies.push_back(pinnedBox("floor", {0.0, -12.0}, 200.0, 1.0));
  const double x = 0.5 * (kOpening + kLength * std::cos(kSlope));
  const double y = 0.5 * kLength * std::sin(kSlope);
  scene.bodies.push_back(pinnedBox("left wall", {-x, y}, kLength, 1.0, -kSlope));
  scene.bodies.push_back(pinnedBox("right wall", {x, y}, kLength, 1.0, kSlope));

  const double bottom = 0.5 * kColumns * kGrid * std::tan(kSlope) + 1.0;
  for (int i = 0; i < count; ++i) {
    const Vec2 at(kGrid * (i % kColumns - 0.5 * (kColumns - 1)), bottom + kGrid * (i / kColumns));
    addBox(scene, at, kSize, kSize);
  }
  return {scene, Expectation::Moves};
}

BenchScene freeFall(int count) {
  constexpr double kApart = 3.0;
  Scene scene = emptyScene(fmt::format("free-fall-{}", count));
  const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
  for (int i = 0; i < count; ++i) {
    addBox(scene, {kApart * (i % columns), kApart * (i / columns)}, 1.0, 1.0);
    scene.bodies.back().spin = 0.1 * (i % 7 - 3);
  }
  return {scene, Expectation::Moves};
}

namespace {

constexpr double kStacksApart = 2.0;  // [m]
constexpr int kHigh = 5;

void addStack(Scene& scene, double x) {
  for (int row = 0; row < kHigh; ++row) addBox(scene, {x, row + 0.5}, 1.0, 1.0);
}

}  // namespace

BenchScene stacks(int count) {
  Scene scene = emptyScene(fmt::format("stacks-{}x{}", count, kHigh));
  scene.bodies.push_back(
      pinnedBox("ground", {0.5 * kStacksApart * count, -0.5}, kStacksApart * (count + 2), 1.0));
  for (int i = 0; i < count; ++i) addStack(scene, kStacksApart * i);
  return {scene, Expectation::Stands};
}

BenchScene swingingStacks(int count) {
  Scene scene = emptyScene(fmt::format("swinging-stacks-{}x{}", count, kHigh));
  addPlatform(scene, kStacksApart * (count + 2));
  for (int i = 0; i < count; ++i) addStack(scene, kStacksApart * (i - 0.5 * (count - 1)));
  return {scene, Expectation::Stands};
}

BenchScene wall(int count) {
  constexpr int kRows = 20;
  const int columns = count / kRows;
  Scene scene = emptyScene(fmt::format("wall-{}", count));
  scene.bodies.push_back(pinnedBox("ground", {0.0, -0.5}, kSpacing * columns + 20.0, 1.0));
  for (int row = 0; row < kRows; ++row) {
    const double left = -0.5 * kSpacing * columns + (row % 2 == 1 ? 0.5 * kSpacing : 0.0);
    for (int i = 0; i < columns; ++i) {
      addBox(scene, {left + kSpacing * i, row + 0.5}, 1.0, 1.0);
    }
  }
  return {scene, Expectation::Stands};
}

BenchScene rain(int count) {
  constexpr int kEvery = 10;
  constexpr double kAbove = 25.0;  // [m]
  BenchScene of = wall(count);
  of.scene.name = of.scene.title = fmt::format("rain-on-wall-{}", count);
  of.rain = {.every = kEvery,
             .body = box("drop", {0.0, kAbove}, 1.0, 1.0),
             .width = kSpacing * (count / 20 - 2)};
  return of;
}

BodyDesc dropOf(const Rain& rain, std::int64_t step) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);  // spreads them evenly
  const double place = golden * static_cast<double>(step / rain.every);
  BodyDesc drop = rain.body;
  drop.name = fmt::format("drop[{}]", step);
  drop.at.x() += (place - std::floor(place) - 0.5) * rain.width;
  return drop;
}

std::vector<BenchScene> benchScenes(bool quick) {
  std::vector<BenchScene> scenes = {tower(100), tower(326), tower(1000)};
  if (!quick) scenes.push_back(tower(5000));
  scenes.push_back(pyramid(50));
  if (!quick) {
    scenes.push_back(pyramid(100));
    scenes.push_back(pyramids(400));
    scenes.push_back(swingingStacks(10'000));
    for (BenchScene large : {tower(20'000), wall(99'980)}) {
      large.large = true;
      scenes.push_back(std::move(large));
    }
  }
  scenes.push_back(rain(5000));
  scenes.push_back(funnel(1500));
  scenes.push_back(tumbler(2025));
  scenes.push_back(freeFall(10'000));
  return scenes;
}

}  // namespace merge2d::bench
