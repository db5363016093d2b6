#pragma once
/// Which frames there are, and what they show.

#include <cstdint>

#include "app/render_options.h"

namespace merge2d {

/// Frame k shows the state at the time k / fps; the last one shows the end of the run.
struct Film {
  int fps = 30;
  double step = 0.01;      ///< h [s]
  std::int64_t steps = 0;  ///< of the whole run
  std::int64_t last = 0;   ///< number of the run's last frame
  /// The frames that are to be drawn, inclusive.
  std::int64_t from = 0, to = 0;

  /// The step after which a frame's state is reached: within half a step of its time.
  std::int64_t stepOf(std::int64_t frame) const;
};

/// Throws UsageError when the options ask for frames that the run does not have.
Film filmOf(const Scene& scene, const RenderOptions& options);

}  // namespace merge2d
