#pragma once
/// Runs of a scene in each mode, and at the time steps that people use.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "src2d/scene/names.h"
#include "tests/support/scenes.h"

namespace merge2d {

inline constexpr std::array kAllModes{Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep};
inline constexpr std::array kStepSizes{1.0 / 60.0, 1.0 / 100.0, 1.0 / 240.0};  ///< [s]

/// Calls `f(mode, h)` for the four modes at the three steps, and says where it failed.
template <class F>
void inEachModeAndStep(F&& f) {
  for (const Mode mode : kAllModes) {
    for (const double h : kStepSizes) {
      SCOPED_TRACE(std::string(nameOf(mode)) + ", h = 1/" + std::to_string(std::lround(1.0 / h)));
      f(mode, h);
    }
  }
}

/// Calls `check(world)` for a new world of a scene in each mode at each of the steps.
template <class Check>
void inAllModesAndSteps(Scene scene, Check&& check) {
  inEachModeAndStep([&](Mode mode, double h) {
    scene.step = h;
    World world(scene, inMode(mode));
    check(world);
  });
}

/// A world of this text, in steps of `h` [s].
inline World worldOf(const std::string& toml, Mode mode, double h) {
  Scene scene = sceneOf(toml);
  scene.step = h;
  return World(scene, inMode(mode));
}

inline BodyDesc moving(BodyDesc body, const Vec2& velocity) {
  body.velocity = velocity;
  return body;
}

}  // namespace merge2d
