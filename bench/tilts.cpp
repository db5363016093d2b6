/// Random walls on a ground that tilts slowly, merged and in a hard reference that has converged:
/// at which angle do they fall? Soft contacts lean, and what has parted is as soft as in the
/// reference with the same settings, which falls before the hard one: early is what falls before
/// both.
///
///   tilts [--cases N] [--seed N] [--quiet]

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "bench/random_scene.h"
#include "src2d/world.h"

namespace merge2d::bench {
namespace {

struct Wall {
  int columns, rows;
  double shift;   ///< of every other row [m]
  double height;  ///< of a brick, which is 1 m wide [m]
  double friction;
  double rate;  ///< at which the ground tilts [degrees per second]
};

Wall randomWall(Random& random) {
  const auto one = [&](auto values) { return values[random.below(values.size())]; };
  Wall wall{};
  wall.columns = one(std::array{1, 1, 2, 3, 4, 6});
  wall.rows = one(std::array{2, 3, 5, 8, 12, 18});
  wall.shift = wall.columns > 1 ? one(std::array{0.0, 0.25}) : 0.0;
  wall.height = one(std::array{0.3, 0.5, 1.0});
  wall.friction = one(std::array{0.3, 0.5, 0.8});
  wall.rate = one(std::array{0.5, 1.0, 2.0});
  return wall;
}

Scene sceneOf(const Wall& wall) {
  Scene scene;
  BodyDesc ground = box("ground", 60.0, 1.0, {0.0, 0.0});
  ground.motion = Motion::Scripted;
  ground.script = SteadyMotion{.spin = -wall.rate * kDegree};
  scene.bodies.push_back(ground);
  for (int row = 0; row < wall.rows; ++row) {
    const double left = -0.5 * (wall.columns - 1) + wall.shift * (row % 2);
    for (int column = 0; column < wall.columns; ++column) {
      scene.bodies.push_back(box(fmt::format("brick[{},{}]", column, row), 1.0, wall.height,
                                 {left + column, 0.5 + wall.height * (row + 0.5)}));
    }
  }
  for (BodyDesc& body : scene.bodies) body.friction = wall.friction;
  return scene;
}

/// The places of all bricks, seen from the ground.
std::vector<Vec2> placesOf(const World& world) {
  const Snapshot now = world.capture();
  const Pose ground = now.bodies[0].pose();
  std::vector<Vec2> places;
  for (const BodyState& b : now.bodies) places.push_back(ground.inverse() * b.x);
  return places;
}

/// The tilt at which a quarter of the bricks has moved by 10 cm since it was 1.5 degrees; 45 if
/// none do [degrees].
double angleOfFall(const Scene& scene, Mode mode, double rate) {
  World world(scene, {.mode = mode, .timings = false});
  const auto angle = [&] { return rate * world.time(); };
  while (angle() < 1.5) world.step();
  const std::vector<Vec2> before = placesOf(world);
  while (angle() < 45.0) {
    world.step(), world.step();
    const std::vector<Vec2> now = placesOf(world);
    std::size_t moved = 0;
    for (std::size_t i = 1; i < now.size(); ++i) moved += (now[i] - before[i]).norm() > 0.1 ? 1 : 0;
    if (4 * moved >= now.size() - 1) break;
  }
  return angle();
}

void run(const Cases& cases) {
  int early = 0, late = 0;
  double sum = 0.0;
  for (int i = 0; i < cases.count; ++i) {
    Random random = cases.random(i);
    const Wall wall = randomWall(random);
    Scene scene = sceneOf(wall);
    scene.settings.unmerging.rule = cases.rule;
    const double merged = angleOfFall(scene, Mode::Merge, wall.rate);
    const double soft = angleOfFall(scene, Mode::Reference, wall.rate);
    scene.settings.solver.iterations = 200;
    scene.settings.solver.compliance = 1e-5;
    const double reference = angleOfFall(scene, Mode::Reference, wall.rate);
    const double off = merged - std::clamp(merged, std::min(soft, reference), reference);
    early += off < -1.0 ? 1 : 0;
    late += off > 1.0 ? 1 : 0;
    sum += std::abs(off);
    if (cases.quiet) continue;
    fmt::print(
        "{} {:2}x{:<2} shift {:4} m, height {:3} m, friction {}, {:3} deg/s: {:5.2f}, "
        "reference {:5.2f} deg, soft {:5.2f} deg\n",
        std::abs(off) > 1.0 ? "OFF" : "ok ", wall.columns, wall.rows, wall.shift, wall.height,
        wall.friction, wall.rate, merged, reference, soft);
  }
  fmt::print("Of {} walls {} fall more than a degree early, {} late; {:.2f} degrees on average.\n",
             cases.count, early, late, sum / cases.count);
}

}  // namespace
}  // namespace merge2d::bench

int main(int argc, char** argv) {
  CLI::App app{"Random walls on a ground that tilts, merged and in the reference"};
  merge2d::bench::Cases cases{.count = 80};
  cases.addTo(app);
  CLI11_PARSE(app, argc, argv);
  merge2d::bench::run(cases);
  return 0;
}
