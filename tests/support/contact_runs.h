#pragma once
/// Runs of a scene in every mode and at every step size.

#include <array>
#include <string>

#include "tests/support/scenes.h"

namespace merge2d {

inline constexpr std::array kAllModes{Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep};
inline constexpr std::array kStepSizes{1.0 / 60.0, 1.0 / 100.0, 1.0 / 240.0};  ///< [s]

/// Calls `check(world)` for a new world in each mode at each of the steps.
template <class Check>
void inAllModesAndSteps(Scene scene, Check&& check) {
  for (const double h : kStepSizes) {
    for (const Mode mode : kAllModes) {
      scene.step = h;
      World world(scene, inMode(mode));
      SCOPED_TRACE("mode " + std::to_string(static_cast<int>(mode)) + ", step 1/" +
                   std::to_string(std::lround(1.0 / h)));
      check(world);
    }
  }
}

inline BodyDesc moving(BodyDesc body, const Vec2& velocity) {
  body.velocity = velocity;
  return body;
}

}  // namespace merge2d
