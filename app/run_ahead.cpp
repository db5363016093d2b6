#include "app/run_ahead.h"

#include <algorithm>

#include "app/interrupt.h"
#include "app/simulation.h"
#include "src2d/core/error.h"

namespace merge2d {

Coverage coverageOf(const std::shared_ptr<const Scene>& scene, Mode mode) {
  constexpr std::int64_t kLooks = 1000;  // at places between two of them nobody misses anything
  World world(scene, {.mode = mode, .timings = false});
  const std::int64_t steps = stepCount(*scene), every = std::max<std::int64_t>(1, steps / kLooks);
  Snapshot snapshot;
  Coverage seen;
  const auto look = [&] {
    world.capture(snapshot);
    seen.add(snapshot, world.bodies());
  };
  look();
  try {
    while (world.steps() < steps) {
      stopIfInterrupted();
      world.step();
      if (world.steps() % every == 0 || world.steps() == steps) look();
    }
  } catch (const SimulationError&) {  // the rendering will tell
  }
  return seen;
}

}  // namespace merge2d
