#include "app/timed_run.h"

namespace merge2d {

void TimedRun::advance(std::int64_t steps) {
  times_.clear();
  for (std::int64_t i = 0; i < steps && !simulation_.done(); ++i) {
    simulation_.step();
    StepTime& time = times_.emplace_back(StepTime{.ms = simulation_.milliseconds().back()});
    for (std::size_t s = 0; s < kStages; ++s) {
      time.stage_ms[s] = static_cast<float>(1e3 * stats().seconds[s]);
    }
  }
}

}  // namespace merge2d
