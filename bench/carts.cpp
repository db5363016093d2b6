/// Random towers on carts that move, and random columns on ground that turns and stays: when do
/// they topple, merged and in the reference? Only those that topple in the reference count.
///
///   carts [--family carts|columns] [--cases N] [--seed N] [--rule default|paper] [--quiet]
///
/// A cart floats on springs, hangs on two rods, stands on springs or is pulled by a force. The
/// reference is a converged one: contacts ten times as hard, 100 sweeps. A softer one can topple
/// where statics say that the tower stands.

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "bench/random_mounts.h"
#include "bench/random_scene.h"
#include "src2d/world.h"

namespace merge2d::bench {
namespace {

/// Boxes of one size on top of each other, of which one may be denser.
struct Tower {
  int boxes;
  double width, height;  ///< of each [m]
  int heavy = -1;
  double density = 1.0;  ///< of that one [kg/m²]

  /// The tilt at which it tips as one rigid body [rad].
  double tips() const {
    double mass = 0.0, moment = 0.0;
    for (int i = 0; i < boxes; ++i) {
      const double m = i == heavy ? density : 1.0;
      mass += m;
      moment += m * (i + 0.5) * height;
    }
    return std::atan2(0.5 * width * mass, moment);
  }
};

Tower randomTower(Random& random, int boxes) {
  return {.boxes = boxes,
          .width = oneOf(random, std::array{0.4, 0.6, 0.8}),
          .height = oneOf(random, std::array{0.3, 0.4, 0.6})};
}

/// Adds the tower with its foot at a place, moving with the first body.
void add(Scene& scene, const Tower& tower, const Vec2& foot) {
  for (int i = 0; i < tower.boxes; ++i) {
    const Vec2 at = foot + Vec2(0.0, (i + 0.5) * tower.height);
    BodyDesc body = box(fmt::format("box[{}]", i), tower.width, tower.height, at);
    if (i == tower.heavy) body.density = tower.density;
    body.velocity = scene.bodies.front().velocity;
    scene.bodies.push_back(body);
  }
}

Scene cart(Random& random) {
  Scene scene;
  BodyDesc seat = box("cart", 3.0, 0.2, {0.0, 0.0});
  seat.mass = oneOf(random, std::array{10.0, 100.0, 1000.0});
  scene.bodies.push_back(seat);
  kMounts[random.below(kMounts.size())](scene, random);
  const Tower tower = randomTower(random, 2 + static_cast<int>(random.below(11)));
  add(scene, tower, {random.between(-0.3, 0.3), 0.1});
  for (BodyDesc& body : scene.bodies) body.friction = 1.2;
  return scene;
}

/// Ground that turns in a second and a half to an angle at which the column tips, and stays.
Scene column(Random& random) {
  Scene scene;
  Tower tower = randomTower(random, 3 + static_cast<int>(random.below(4)));
  tower.heavy = oneOf(random, std::array{-1, tower.boxes / 2, tower.boxes - 1});
  tower.density = oneOf(random, std::array{20.0, 100.0});
  const double angle = tower.tips() * random.between(1.02, 1.3);
  BodyDesc ground = box("ground", 30.0, 1.0, {0.0, 0.0});
  ground.motion = Motion::Scripted;
  const Vec2 origin = Vec2::Zero();
  ground.script = Keyframes{
      {{0.0, origin, 0.0}, {1.0, origin, 0.0}, {2.5, origin, angle}, {60.0, origin, angle}}};
  scene.bodies.push_back(ground);
  add(scene, tower, {0.0, 0.5});
  for (BodyDesc& body : scene.bodies) body.friction = 2.0;
  return scene;
}

/// When the top box has turned by 15 degrees or moved by a quarter of a metre against the first
/// body, or kNever [s].
double timeOfFall(const Scene& scene, Mode mode, double until) {
  World world(scene, {.mode = mode, .timings = false});
  const auto seen = [&] {
    const Snapshot now = world.capture();
    const Pose cart = now.bodies.front().pose();
    const BodyState& top = now.bodies.back();
    return std::pair(Vec2(cart.inverse() * top.x), top.angle - now.bodies.front().angle);
  };
  const auto [place, angle] = seen();
  while (world.time() < until) {
    world.step();
    const auto [place_now, angle_now] = seen();
    if ((place_now - place).norm() > 0.25 || std::abs(angle_now - angle) > 15.0 * kDegree) {
      return world.time();
    }
  }
  return kNever;
}

void run(const Cases& cases, bool columns) {
  constexpr double kLate = 0.3;  // [s]
  const double until = columns ? 14.0 : 12.0;
  int tip = 0, never = 0, late = 0, early = 0;
  for (int i = 0; tip < cases.count; ++i) {
    Random random = cases.random(i);
    Scene scene = columns ? column(random) : cart(random);
    scene.settings.unmerging.rule = cases.rule;
    const double reference = timeOfFall(hardened(scene), Mode::Reference, until);
    if (reference > until - 2.0) continue;
    const double soft = timeOfFall(scene, Mode::Reference, until);
    const double merged = timeOfFall(scene, Mode::Merge, until);
    ++tip;
    const bool stands = merged == kNever, is_late = !stands && merged > reference + kLate;
    const bool is_early = merged < std::min(reference, soft) - kLate;
    never += stands ? 1 : 0;
    late += is_late ? 1 : 0;
    early += is_early ? 1 : 0;
    if (cases.quiet) continue;
    fmt::print("{} {:4}: {:2} boxes: {} s, reference {} s, soft {} s\n",
               stands || is_late || is_early ? "OFF" : "ok ", i, scene.bodies.size() - 1,
               shown(merged), shown(reference), shown(soft));
  }
  fmt::print("Of {} {} {} stand for ever, {} topple more than {} s late, {} as much early.\n", tip,
             columns ? "columns" : "towers on carts", never, late, kLate, early);
}

}  // namespace
}  // namespace merge2d::bench

int main(int argc, char** argv) {
  CLI::App app{"Towers that topple, merged and in the reference"};
  merge2d::bench::Cases cases{.count = 90};
  std::string family = "carts";
  app.add_option("--family", family, "carts or columns")
      ->check(CLI::IsMember({"carts", "columns"}));
  cases.addTo(app);
  CLI11_PARSE(app, argc, argv);
  merge2d::bench::run(cases, family == "columns");
  return 0;
}
