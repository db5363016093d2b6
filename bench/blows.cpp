/// Random blows on things that stand, merged and in the reference side by side: how often does
/// merging get it grossly wrong?
///
///   blows [--cases N] [--seed N] [--iterations N] [--reference-iterations N] [--quiet]

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "bench/random_scene.h"
#include "src2d/world.h"

namespace merge2d::bench {
namespace {

/// Boxes of 1 m on the ground; `rows` of `columns`, each row moved by `shift` [m] against the last,
/// or one box shorter.
struct Kind {
  const char* name;
  int rows, columns;
  double shift;
  bool tapers;
};
constexpr std::array kKinds{
    Kind{"wall", 12, 10, 0.5, false},  Kind{"low wall", 6, 4, 0.5, false},
    Kind{"column", 10, 1, 0.0, false}, Kind{"pyramid", 8, 8, 0.5, true},
    Kind{"row", 1, 10, 0.0, false},    Kind{"columns", 8, 3, 0.0, false},
};

Scene sceneOf(const Kind& kind, int iterations) {
  Scene scene;
  scene.settings.solver.iterations = iterations;
  BodyDesc ground = box("ground", 200.0, 1.0, {0.0, -0.5});
  ground.motion = Motion::Pinned;
  scene.bodies.push_back(ground);
  for (int row = 0; row < kind.rows; ++row) {
    const int columns = kind.tapers ? kind.columns - row : kind.columns;
    const double left = kind.shift * (kind.tapers ? row : row % 2);
    for (int column = 0; column < columns; ++column) {
      const std::string name = fmt::format("box[{},{}]", column, row);
      scene.bodies.push_back(box(name, 1.0, 1.0, {left + column, 0.5 + row}));
    }
  }
  return scene;
}

struct Blow {
  BodyId body{};
  Vec2 impulse = Vec2::Zero();  ///< [N s]
};

Blow randomBlow(Random& random, std::size_t bodies) {
  const BodyId body{static_cast<std::uint32_t>(1 + random.below(bodies - 1))};
  const double side = random.below(2) == 0 ? 0.0 : std::numbers::pi;
  const double angle = random.below(5) == 0 ? random.between(0.0, 2.0 * std::numbers::pi)
                                            : side + random.between(-0.6, 0.6);
  const double size = std::exp(random.between(0.0, std::log(200.0)));
  return {body, size * Vec2(std::cos(angle), std::sin(angle))};
}

/// Bodies that have moved by 1 cm 0.05, 0.5 and 2 s after the blow.
std::array<int, 3> movedAfter(const Scene& scene, Mode mode, const Blow& blow) {
  World world(scene, {.mode = mode, .timings = false});
  for (int i = 0; i < 250; ++i) world.step();
  const Snapshot before = world.capture();
  world.applyImpulse(blow.body, before.bodies[index(blow.body)].x, blow.impulse);
  std::array<int, 3> moved{};
  int steps = 0;
  const std::array until{5, 50, 200};
  for (std::size_t k = 0; k < until.size(); ++k) {
    for (; steps < until[k]; ++steps) world.step();
    const Snapshot now = world.capture();
    for (std::size_t b = 0; b < now.bodies.size(); ++b) {
      moved[k] += (now.bodies[b].x - before.bodies[b].x).norm() > 0.01 ? 1 : 0;
    }
  }
  return moved;
}

/// Half as many as in the reference, or twice as many; of few some more or less do not count.
bool isOff(int moved, int reference) {
  if (reference < 4) return moved > reference + 4;
  return 2 * moved < reference || moved > 2 * reference + 1;
}

void run(const Cases& cases, int iterations, int in_the_reference) {
  int off = 0;
  int in_reference = 0, in_merged = 0, differing = 0;  // bodies that have moved in the end
  for (int i = 0; i < cases.count; ++i) {
    const Kind& kind = kKinds[static_cast<std::size_t>(i) % kKinds.size()];
    Scene scene = sceneOf(kind, iterations);
    scene.settings.unmerging.rule = cases.rule;
    Random random = cases.random(i);
    const Blow blow = randomBlow(random, scene.bodies.size());
    const auto merged = movedAfter(scene, Mode::Merge, blow);
    scene.settings.solver.iterations = in_the_reference;
    const auto reference = movedAfter(scene, Mode::Reference, blow);
    bool wrong = false;
    for (std::size_t k = 0; k < 3; ++k) wrong |= isOff(merged[k], reference[k]);
    off += wrong ? 1 : 0;
    in_reference += reference.back();
    in_merged += merged.back();
    differing += std::abs(merged.back() - reference.back());
    if (cases.quiet) continue;
    fmt::print("{} {:8} {:12} {:7.1f} {:7.1f} N s: moved {}/{} {}/{} {}/{}\n",
               wrong ? "OFF" : "ok ", kind.name, scene.bodies[index(blow.body)].name,
               blow.impulse.x(), blow.impulse.y(), merged[0], reference[0], merged[1], reference[1],
               merged[2], reference[2]);
  }
  fmt::print(
      "{} of {} blows with {} iterations move fewer than half or more than twice as many bodies as "
      "in the reference.\nIn the end they have moved {} bodies, {} in the reference, off by {} in "
      "all.\n",
      off, cases.count, iterations, in_merged, in_reference, differing);
}

}  // namespace
}  // namespace merge2d::bench

int main(int argc, char** argv) {
  CLI::App app{"Random blows, merged and in the reference"};
  merge2d::bench::Cases cases{.count = 120};
  int iterations = 30, in_the_reference = 0;
  app.add_option("--iterations", iterations, "Of the solver");
  app.add_option("--reference-iterations", in_the_reference, "In the reference, if others");
  cases.addTo(app);
  CLI11_PARSE(app, argc, argv);
  merge2d::bench::run(cases, iterations, in_the_reference > 0 ? in_the_reference : iterations);
  return 0;
}
