/// [[emitter]] of a scene file.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src2d/scene/interpret.h"

namespace merge2d {
namespace {

/// How many times start, start + every, … lie before `until`.
double countBefore(double until, double start, double every) {
  constexpr double kRounding = 1e-9;  // 0.3 / 0.1 means 3, not 4
  return std::max(0.0, std::ceil((until - start) / every - kRounding));
}

void readSchedule(TableReader& table, EmitterDesc& emitter) {
  constexpr double kMost = static_cast<double>(SceneLimits::kBodies);
  if (table.require("every")) table.read("every", emitter.every, kPositive);
  table.read("start", emitter.start, kNotNegative);
  double count = kMost + 1;
  if (const auto value = table.get("count")) {
    count = static_cast<double>(value->integer({1, kMost, "between 1 and 100000"}));
  }
  if (const auto value = table.get("until")) {
    const double until = value->number(kNotNegative);
    count = std::min(count, countBefore(until, emitter.start, emitter.every));
    if (count < 1) value->fail("the emitter ends before it starts: 'until' must exceed 'start'");
    if (count > kMost) {
      value->fail(
          fmt::format("one body every {} s until {} s makes more than the {} that a scene "
                      "may have",
                      emitter.every, until, SceneLimits::kBodies));
    }
  }
  emitter.count = static_cast<int>(std::min(count, kMost + 1));
}

EmitterDesc readEmitter(TableReader& table, const Scene& scene) {
  EmitterDesc emitter;
  const std::size_t number = scene.emitters.size();
  emitter.seed = scene.seed + number;
  BodyDesc defaults = defaultBody(scene.settings.material);
  defaults.name = fmt::format("emitted{}", number + 1);
  emitter.body = readBody(table, defaults);
  readSchedule(table, emitter);
  table.read("spread", emitter.spread, {0, SceneLimits::kCoordinate, "between 0 and 1e6 m"});
  table.read("seed", emitter.seed, kSeed);
  const bool ends = table.has("count") || table.has("until");
  table.done();
  if (!ends) table.fail("an emitter needs an end: 'count' or 'until'");
  checkBody(table, emitter.body);
  if (emitter.body.motion != Motion::Dynamic) {
    table.failAt("motion", "an emitter's bodies are dynamic");
  }
  return emitter;
}

/// "box" clashes with the bodies "box" and "box[3]".
bool clashes(const std::string& emitter, const std::string& body) {
  return body.starts_with(emitter) &&
         (body.size() == emitter.size() || body[emitter.size()] == '[');
}

void checkClashes(const TableReader& table, const EmitterDesc& emitter, const Scene& scene) {
  const std::string& name = emitter.body.name;
  const auto complain = [&](const std::string& other) {
    if (!clashes(name, other)) return;
    table.failAt("name",
                 fmt::format("the emitter's bodies '{}[0]', … clash with '{}'", name, other));
  };
  for (const BodyDesc& body : scene.bodies) complain(body.name);
  for (const EmitterDesc& other : scene.emitters) complain(other.body.name);
}

}  // namespace

void readEmitters(TableReader& root, Scene& scene) {
  std::size_t bodies = scene.bodies.size();
  for (TableReader& table : root.tables("emitter")) {
    const EmitterDesc emitter = readEmitter(table, scene);
    checkClashes(table, emitter, scene);
    bodies += static_cast<std::size_t>(emitter.count);
    if (bodies > SceneLimits::kBodies) {
      table.failAt("count", fmt::format("a scene has at most {} bodies, but with the emitted ones "
                                        "this makes {}",
                                        SceneLimits::kBodies, bodies));
    }
    scene.emitters.push_back(emitter);
  }
}

}  // namespace merge2d
