#include "app/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/simulation.h"
#include "app/usage_error.h"

namespace merge2d {
namespace {

constexpr double kRounding = 1e-6;  // of counts of frames and steps

}  // namespace

std::int64_t Film::stepOf(std::int64_t frame) const {
  const double exact = static_cast<double>(frame) / (fps * step);
  const auto nearest = static_cast<std::int64_t>(std::ceil(exact - 0.5 - kRounding));
  return frame == last ? steps : std::clamp<std::int64_t>(nearest, 0, steps);
}

Film filmOf(const Scene& scene, const RenderOptions& options) {
  Film film{.fps = options.framesPerSecond(), .step = scene.step, .steps = stepCount(scene)};
  const double frames = std::ceil(scene.duration * film.fps - kRounding);
  if (frames >= static_cast<double>(kMostFrames)) {
    throw UsageError(
        fmt::format("{:.0f} frames are more than a million; lower --fps or --seconds", frames));
  }
  film.last = static_cast<std::int64_t>(std::max(0.0, frames));
  film.to = film.last;
  if (options.last_only) film.from = film.last;
  if (options.range) {
    film.from = options.range->from;
    film.to = std::min(film.last, options.range->to.value_or(film.last));
    if (film.from > film.last) {
      throw UsageError(fmt::format("there is no frame {}: the run has the frames 0 to {}",
                                   film.from, film.last));
    }
  }
  return film;
}

}  // namespace merge2d
