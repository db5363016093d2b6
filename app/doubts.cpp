#include "app/doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "src2d/world.h"

namespace merge2d {

void warnOfOverlaps(Scene& scene) {
  World world(scene, {.mode = Mode::Reference, .timings = false});
  world.step();  // finds the contacts of the starting poses
  const Snapshot snapshot = world.capture();
  const double tolerance = std::max(scene.settings.solver.margin, 1e-3);
  std::map<std::pair<BodyId, BodyId>, double> overlaps;  // [m]
  for (const ContactView& contact : snapshot.contacts) {
    if (-contact.gap <= tolerance) continue;
    double& deepest = overlaps[{contact.a, contact.b}];
    deepest = std::max(deepest, -contact.gap);
  }
  if (overlaps.empty()) return;
  const auto& [pair, depth] = *std::ranges::max_element(
      overlaps, [](const auto& x, const auto& y) { return x.second < y.second; });
  const auto& bodies = world.bodies();
  scene.warnings.push_back(fmt::format(
      "'{}' and '{}' overlap by {:.3g} m at the start{}", bodies[index(pair.first)].name,
      bodies[index(pair.second)].name, depth,
      overlaps.size() > 1 ? fmt::format(", and {} more pairs by less", overlaps.size() - 1) : ""));
}

void warnOfWhatComesTooLate(Scene& scene) {
  const auto check = [&](double time, std::string_view kind, std::size_t i, std::string_view name) {
    if (time < scene.duration) return;
    scene.warnings.push_back(
        fmt::format("{}[{}] of '{}' is due at {} s, but the scene ends at {} s", kind, i, name,
                    time, scene.duration));
  };
  const auto checkEach = [&](const auto& actions, std::string_view kind, auto timeOf) {
    for (std::size_t i = 0; i < actions.size(); ++i) {
      check(timeOf(actions[i]), kind, i, scene.bodies[actions[i].body].name);
    }
  };
  checkEach(scene.impulses, "impulse", [](const ImpulseDesc& impulse) { return impulse.time; });
  checkEach(scene.forces, "force", [](const ForceDesc& force) { return force.from; });
  for (std::size_t i = 0; i < scene.magnets.size(); ++i) {
    const MagnetDesc& magnet = scene.magnets[i];
    for (const auto& on : magnet.on) check(on.from, "magnet", i, scene.bodies[magnet.body].name);
  }
  for (std::size_t i = 0; i < scene.emitters.size(); ++i) {
    check(scene.emitters[i].start, "emitter", i, scene.emitters[i].body.name);
  }
}

}  // namespace merge2d
