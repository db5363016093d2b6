#include "bench/growth_situations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>

#include "bench/bench_scenes.h"
#include "src2d/world.h"

namespace merge2d::bench {
namespace {

/// Largest exponents. `kWork` is that of costs which the work of a step decides. `kPass` is that of
/// costs which the memory of a pass decides: of so many bodies that no cache holds them, where the
/// cost grows like N^1.2 to N^1.4.
constexpr double kWork = 1.15, kPass = 1.5;
/// `kFlat` is that of costs that do not depend on the number: measured −0.1 to 0.26 beside other
/// programs. One look a step at each stack that sleeps, 0.16 ns by body, made 0.5.
constexpr double kFlat = 0.3;
/// `kSurface` is that of costs of a heap's surface, N^0.5, where caches add to it: measured up to
/// 0.9. A cost of all members beside a constant may be below it; one that is far larger is not.
constexpr double kSurface = 1.0;
constexpr int kMany = 2000;  ///< short steps, of which the mean or the median counts

/// Processor time of this thread [s]: other programs do not count.
double threadSeconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double secondsOf(const std::function<void()>& work) {
  const double start = threadSeconds();
  work();
  return threadSeconds() - start;
}

double slowestStep(World& world, int steps) {
  double slowest = 0.0;
  for (int i = 0; i < steps; ++i) slowest = std::max(slowest, secondsOf([&] { world.step(); }));
  return slowest;
}

double meanStep(World& world, int steps) {
  return secondsOf([&] {
           for (int i = 0; i < steps; ++i) world.step();
         }) /
         steps;
}

void run(World& world, int steps) {
  for (int i = 0; i < steps; ++i) world.step();
}

World worldOf(const BenchScene& of, Mode mode) {
  return World(of.scene, {.mode = mode, .timings = false});
}

double allStacksMerge(int n) {
  World world = worldOf(stacks(n / 5), Mode::Merge);
  return slowestStep(world, 12);
}

double stepAfterKicks(int n, int kicks) {
  World world = worldOf(freeFall(n), Mode::Reference);
  run(world, 5);
  for (int i = 0; i < kicks; ++i) {
    const BodyId body{static_cast<std::uint32_t>(i)};
    world.applyImpulse(body, world.scene().bodies[static_cast<std::size_t>(i)].at, {1.0, 0.5});
  }
  return secondsOf([&] { world.step(); });
}

double allAreKicked(int n) { return stepAfterKicks(n, n); }
double noneIsKicked(int n) { return stepAfterKicks(n, 0); }

double allSleep(int n) {
  World world = worldOf(stacks(n / 5), Mode::MergeSleep);
  run(world, 200);
  return meanStep(world, kMany);
}

/// A floor, or pinned tiles side by side, with the surface at y = 0.
BenchScene groundOf(int pieces, double width) {
  BenchScene of;
  of.scene.step = 0.01;
  of.scene.settings.solver.iterations = 10;
  for (int i = 0; i < pieces; ++i) {
    BodyDesc piece;
    piece.name = fmt::format("ground[{}]", i);
    piece.at = {width * (i - 0.5 * (pieces - 1)), -0.5};
    piece.shapes = {makeBox(width, 1.0)};
    piece.motion = Motion::Pinned;
    of.scene.bodies.push_back(piece);
  }
  return of;
}

void addFalling(BenchScene& of, const Vec2& at, double width) {
  BodyDesc body;
  body.name = fmt::format("box[{}]", of.scene.bodies.size());
  body.at = at;
  body.shapes = {makeBox(width, 1.0)};
  of.scene.bodies.push_back(body);
}

/// The last body swings for ever on a spring, from 2 m beside it and 4 m above; when all else
/// sleeps, the world is handed over.
World withTheLastAwake(BenchScene of) {
  SpringDesc spring;
  spring.body = of.scene.bodies.size() - 1;
  spring.to = of.scene.bodies.back().at + Vec2(2.0, 4.0);
  spring.stiffness = 1e4;
  of.scene.springs.push_back(spring);
  World world = worldOf(of, Mode::MergeSleep);
  run(world, 200);
  return world;
}

/// Stacks that sleep, and beside them a box that swings on a spring for ever: the last body.
World sleepersAndOneAwake(int n) {
  BenchScene of = stacks(n / 5);
  BodyDesc lamp = of.scene.bodies.back();
  lamp.name = "lamp";
  lamp.at = {-30.0, 10.0};
  of.scene.bodies.push_back(lamp);
  return withTheLastAwake(of);
}

double allButOneSleep(int n) {
  World world = sleepersAndOneAwake(n);
  return meanStep(world, kMany);
}

/// Pairs of boxes on the ground that a rod joins, one pair beside the other, and a box that swings.
World joinedSleepersAndOneAwake(int n) {
  BenchScene of = groundOf(1, 3.0 * n);
  for (int i = 0; i < n; ++i) addFalling(of, {1.25 * i, 0.5}, 1.0);
  for (std::size_t a = 1; a + 1 < of.scene.bodies.size(); a += 2) {
    JointDesc rod;
    rod.kind = JointKind::Distance;
    rod.a = a;
    rod.b = a + 1;
    rod.at = of.scene.bodies[a].at;
    rod.to = of.scene.bodies[a + 1].at;
    of.scene.joints.push_back(rod);
  }
  addFalling(of, {-3.0, 10.0}, 1.0);
  return withTheLastAwake(of);
}

double joinedPairsSleep(int n) {
  World world = joinedSleepersAndOneAwake(n);
  return meanStep(world, kMany);
}

/// The one that is awake is kicked before each step, to and fro.
double theOneAwakeIsKicked(int n) {
  World world = sleepersAndOneAwake(n);
  const std::size_t last = world.scene().bodies.size() - 1;
  const Vec2 at = world.scene().bodies[last].at;
  return secondsOf([&] {
           for (int i = 0; i < kMany; ++i) {
             world.applyImpulse(BodyId{static_cast<std::uint32_t>(last)}, at,
                                {i % 2 == 0 ? 0.1 : -0.1, 0.0});
             world.step();
           }
         }) /
         kMany;
}

/// The median time of the contact detection of a scene in which all has merged: in some steps a
/// leaf leaves its box, which takes 12 µs with any number of bodies.
double detectionOf(const BenchScene& of) {
  World world(of.scene, {.mode = Mode::Merge, .timings = true});
  run(world, 300);
  std::vector<double> seconds;
  for (int i = 0; i < kMany; ++i) {
    world.step();
    seconds.push_back(world.stats().seconds[static_cast<std::size_t>(Stage::ContactDetection)]);
  }
  std::ranges::nth_element(seconds, seconds.begin() + kMany / 2);
  return seconds[kMany / 2];
}

/// The detection of contacts between a heap, merged into one, and the platform that it rides on.
double aHeapRides(int n) { return detectionOf(tower(n)); }

/// The same where six discs, which turn and have no friction, stay on top of the heap:
/// the cost of detection is that of the surface, not of the buried members.
double aHeapIsTouched(int n) {
  BenchScene of = tower(n);
  const Vec2 corner = of.scene.bodies.back().at + Vec2(0.5, 0.5);
  for (int i = 0; i < 6; ++i) {
    BodyDesc disc;
    disc.name = fmt::format("disc[{}]", i);
    disc.at = corner + Vec2(-0.3 - 0.5 * i, 0.2);
    disc.shapes = {Circle{Vec2::Zero(), 0.2}};
    disc.friction = 0.0;
    disc.spin = 2.0;
    of.scene.bodies.push_back(disc);
  }
  return detectionOf(of);
}

/// Pillars of five boxes that stand, each on a shelf of its own that is let go after half a second:
/// all at once.
double allShelvesAreLetGo(int n) {
  BenchScene of;
  of.scene.step = 0.01;
  for (int i = 0; i < n / 5; ++i) {
    BodyDesc shelf;
    shelf.name = fmt::format("shelf[{}]", i);
    shelf.at = {2.0 * i, -0.5};
    shelf.shapes = {makeBox(1.5, 1.0)};
    shelf.pinned_until = 0.5;
    of.scene.bodies.push_back(shelf);
    for (int k = 0; k < 5; ++k) addFalling(of, {2.0 * i, 0.5 + k}, 1.0);
  }
  World world = worldOf(of, Mode::Merge);
  run(world, 45);
  return slowestStep(world, 10);
}

double allFall(int n) {
  World world = worldOf(freeFall(n), Mode::Merge);
  run(world, 20);
  return meanStep(world, 20);
}

/// Boxes side by side fall by 5 cm; where told, every other one stands on the floor already.
double boxesLandOnOneFloor(int n, bool half_stand) {
  constexpr double kSpacing = 1.05, kFall = 0.05;  // [m]
  BenchScene of = groundOf(1, kSpacing * (n + 2));
  for (int i = 0; i < n; ++i) {
    const bool stands = half_stand && i % 2 == 1;
    addFalling(of, {kSpacing * (i - 0.5 * (n - 1)), stands ? 0.5 : 0.5 + kFall}, 1.0);
  }
  World world = worldOf(of, Mode::Reference);
  return slowestStep(world, 20);
}

double allLandOnOneFloor(int n) { return boxesLandOnOneFloor(n, false); }
double halfLandAmongOthers(int n) { return boxesLandOnOneFloor(n, true); }

/// A plank that touches all tiles falls by 5 cm.
double aPlankLandsOnTiles(int n) {
  BenchScene of = groundOf(n, 1.0);
  addFalling(of, {0.0, 0.55}, n);
  World world = worldOf(of, Mode::Reference);
  return slowestStep(world, 20);
}

/// A step of a merged wall of 2000 in which so many of its bricks are kicked, from the middle on.
double bricksAreKicked(int kicks) {
  constexpr int kBricks = 2000;
  World world = worldOf(wall(kBricks), Mode::Merge);
  run(world, 300);
  for (int i = 0; i < kicks; ++i) {
    const auto body = static_cast<std::uint32_t>(1 + (kBricks / 2 + i) % kBricks);
    world.applyImpulse(BodyId{body}, world.scene().bodies[body].at, {1.0, 0.5});
  }
  return secondsOf([&] { world.step(); });
}

double aWallIsStruck(int n) {
  World world = worldOf(wall(n), Mode::Merge);
  run(world, 300);
  world.applyImpulse(BodyId{1}, world.scene().bodies[1].at, {1.0, 0.0});
  return slowestStep(world, 20);
}

/// A disc of 5 cm falls on the middle of a merged wall, by 30 cm; from then on, and a second long.
double aPebbleFalls(int n) {
  constexpr double kFrom = 3.0;
  BenchScene of = wall(n);
  double top = 0.0;
  for (const BodyDesc& b : of.scene.bodies) top = std::max(top, b.at.y() + 0.5);
  BodyDesc pebble;
  pebble.name = "pebble";
  pebble.at = {0.0, top + 0.35};
  pebble.shapes = {Circle{Vec2::Zero(), 0.05}};
  pebble.pinned_until = kFrom;
  of.scene.bodies.push_back(pebble);
  World world = worldOf(of, Mode::Merge);
  run(world, static_cast<int>(std::lround(kFrom / of.scene.step)));
  return meanStep(world, 100);
}

}  // namespace

const std::vector<Situation>& situations() {
  static const std::vector<Situation> all = {
      {"stacks of 5 merge at once: slowest step",
       kWork,
       {5000, 10'000, 20'000, 40'000},
       allStacksMerge},
      // Their memory fits into no cache.
      {"so many stacks of 5 merge at once: slowest step", kPass, {20'000, 80'000}, allStacksMerge},
      {"every body is kicked: that step",
       kWork,
       {1000, 2000, 4000, 8000},
       allAreKicked,
       noneIsKicked},
      {"stacks of 5 sleep: mean step", kFlat, {5000, 10'000, 20'000, 50'000}, allSleep},
      {"all but one sleep: mean step", kFlat, {5000, 10'000, 20'000, 40'000}, allButOneSleep},
      {"all but one sleep, in pairs on a rod: mean step",
       kFlat,
       {1000, 2000, 4000, 8000},
       joinedPairsSleep},
      {"the one awake beside so many asleep is kicked: mean step",
       kFlat,
       {5000, 10'000, 20'000, 40'000},
       theOneAwakeIsKicked},
      {"a merged heap rides: its detection", kSurface, {500, 1000, 2000, 4000}, aHeapRides},
      {"a merged heap is touched: its detection",
       kSurface,
       {500, 1000, 2000, 4000},
       aHeapIsTouched},
      {"so many bodies on shelves, which are let go at once: slowest step",
       kWork,
       {2500, 5000, 10'000, 20'000},
       allShelvesAreLetGo},
      {"boxes fall freely: mean step", kWork, {2500, 5000, 10'000, 20'000}, allFall},
      {"boxes land at once on one floor: slowest step",
       kWork,
       {500, 1000, 2000, 4000},
       allLandOnOneFloor},
      {"boxes land among as many on one floor: slowest step",
       kWork,
       {500, 1000, 2000, 4000},
       halfLandAmongOthers},
      {"a plank lands on so many tiles: slowest step",
       kWork,
       {500, 1000, 2000, 4000},
       aPlankLandsOnTiles},
      {"so many bricks of a merged wall of 2000 are kicked: that step",
       kWork,
       {125, 250, 500, 1000},
       bricksAreKicked},
      {"a merged wall is struck: slowest step", kWork, {1000, 2000, 4000, 8000}, aWallIsStruck},
      {"a pebble falls on a merged wall: mean step", kPass, {5000, kHuge}, aPebbleFalls},
  };
  return all;
}

}  // namespace merge2d::bench
