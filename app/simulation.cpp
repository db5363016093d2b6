#include "app/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "app/doubts.h"
#include "app/interrupt.h"
#include "app/lesson_source.h"
#include "app/usage_error.h"
#include "src2d/core/error.h"
#include "src2d/scene/builtin.h"

namespace merge2d {
namespace {

/// A seed that was asked for, in a scene in which nothing is random.
void warnOfIdleSeed(const SceneOptions& options, const Scene& scene, const Console& console) {
  const bool asked =
      std::ranges::any_of(options.overrides, [](const auto& one) { return one.first == "seed"; });
  const bool random = std::ranges::any_of(
      scene.emitters, [](const EmitterDesc& emitter) { return emitter.spread != Vec2::Zero(); });
  if (!asked || random) return;
  console.warn(
      fmt::format("the seed changes nothing: {} has no [[emitter]] with a 'spread'", scene.name));
}

/// A lesson goes by its name too; a scene of that name comes first.
Scene sceneOrLesson(const SceneOptions& options) {
  if (!builtinScene(options.scene)) {
    if (const auto lesson = lessonNamed(options.scene)) {
      return sceneOfLesson(*lesson, options.overrides);
    }
  }
  return loadScene(options.scene, options.overrides);
}

/// Processor time of this process so far, in all threads [s].
double processorSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

Scene loadScene(const SceneOptions& options, const Console& console) {
  Scene scene = sceneOrLesson(options);
  warnOfMixedRules(scene);
  for (const std::string& warning : scene.warnings) console.warn(warning);
  warnOfIdleSeed(options, scene, console);
  if (options.steps) scene.duration = static_cast<double>(*options.steps) * scene.step;
  if (options.seconds) scene.duration = *options.seconds;
  console.detail(fmt::format("{}: {} bodies, {} steps of {} s, {}", scene.name, scene.bodies.size(),
                             stepCount(scene), scene.step, name(options.mode)));
  return scene;
}

std::int64_t stepCount(const Scene& scene) {
  const double exact = scene.duration / scene.step;
  if (!(exact <= static_cast<double>(kMostSteps))) {
    throw InputError(fmt::format("{} s are more than {} steps of {} s; take fewer with --steps",
                                 scene.duration, kMostSteps, scene.step));
  }
  const double rounding = std::min(0.5, 1e-9 * std::max(1.0, exact));  // 0.3 / 0.1 is 3, not 4
  return static_cast<std::int64_t>(std::ceil(exact - rounding));
}

void requireStep(const Scene& scene, std::int64_t at) {
  const std::int64_t last = stepCount(scene);
  if (at <= last) return;
  throw UsageError(fmt::format(
      "--at {}: the run of '{}' ends at step {}; --set duration={:.10g} makes it long enough", at,
      scene.name, last, static_cast<double>(at) * scene.step));
}

void Simulation::step() {
  using Clock = std::chrono::steady_clock;
  stopIfInterrupted();
  // A look at the processor's time takes as long as a step of a few bodies: never within one.
  const double cpu_start = measures_processor_ ? processorSeconds() : 0.0;
  const Clock::time_point start = Clock::now();
  world_.step();
  milliseconds_.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  if (measures_processor_) cpu_seconds_ += processorSeconds() - cpu_start;
}

}  // namespace merge2d
