#pragma once
/// A run that nobody looks at, for the time that its steps take.

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "app/simulation.h"

namespace merge2d {

/// How long a step took.
struct StepTime {
  double ms = 0.0;                        ///< [ms]
  std::array<float, kStages> stage_ms{};  ///< [ms]
};

/// Looking at a world between two steps drives what the next step needs out of the processor's
/// caches, and lengthens short steps more than long ones. So times are taken of a world that does
/// the same and is left alone.
class TimedRun {
 public:
  TimedRun(std::shared_ptr<const Scene> scene, Mode mode)
      : simulation_(std::move(scene), {.mode = mode}) {}

  /// Takes up to so many steps. Throws SimulationError, or Interrupted.
  void advance(std::int64_t steps);

  /// Of the steps of the last call.
  const std::vector<StepTime>& times() const { return times_; }
  /// Of the last step.
  const Stats& stats() const { return simulation_.world().stats(); }

 private:
  Simulation simulation_;
  std::vector<StepTime> times_;
};

}  // namespace merge2d
