#pragma once
/// A scene that is simulated: what `run` and `render` have in common.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/console.h"
#include "app/options.h"
#include "src2d/world.h"

namespace merge2d {

/// Loads the scene that was asked for and hands on its warnings. Its duration is what --steps or
/// --seconds ask for.
Scene loadScene(const SceneOptions& options, const Console& console);

/// The longest run.
inline constexpr std::int64_t kMostSteps = 1'000'000'000;

/// How many time steps cover the scene's duration.
std::int64_t stepCount(const Scene& scene);

/// Throws UsageError where `--at` names a step after the last one.
void requireStep(const Scene& scene, std::int64_t at);

/// A world, the steps it is to take, and how long they took.
class Simulation {
 public:
  Simulation(std::shared_ptr<const Scene> scene, const WorldOptions& options)
      : scene_(std::move(scene)), world_(scene_, options), steps_(stepCount(*scene_)) {}

  const World& world() const { return world_; }
  const std::shared_ptr<const Scene>& shared() const { return scene_; }
  std::int64_t steps() const { return steps_; }
  bool done() const { return world_.steps() >= steps_; }

  /// Continues from a snapshot; `file` names it in messages. Throws InputError when it does not
  /// fit.
  void resume(std::string_view snapshot, const std::string& file) {
    world_.restore(snapshot, file);
  }

  /// Takes one step. Throws SimulationError, or Interrupted.
  void step();

  /// Of each step so far [ms].
  const std::vector<double>& milliseconds() const { return milliseconds_; }
  /// Measures the processor time of the steps to come.
  void measureProcessor() { measures_processor_ = true; }
  /// Processor time of the steps so far, in all threads; 0 where it is not measured [s].
  double cpuSeconds() const { return cpu_seconds_; }

 private:
  std::shared_ptr<const Scene> scene_;
  World world_;
  std::int64_t steps_;
  bool measures_processor_ = false;
  std::vector<double> milliseconds_;
  double cpu_seconds_ = 0.0;
};

}  // namespace merge2d
