#pragma once
/// What is to hold in each mode, and at the time steps that people use.

#include <gtest/gtest.h>

#include <string>

#include "src2d/scene/names.h"
#include "tests/support/scenes.h"

namespace merge2d {

/// Calls `f(mode, h)` for the four modes at 1/60, 1/100 and 1/240 s, and says where it failed.
template <class F>
void inEachModeAndStep(F&& f) {
  for (const Mode mode : {Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
    for (const int rate : {60, 100, 240}) {
      SCOPED_TRACE(std::string(nameOf(mode)) + ", h = 1/" + std::to_string(rate));
      f(mode, 1.0 / rate);
    }
  }
}

/// A world of this text, in steps of `h` [s].
inline World worldOf(const std::string& toml, Mode mode, double h) {
  Scene scene = sceneOf(toml);
  scene.step = h;
  return World(scene, inMode(mode));
}

}  // namespace merge2d
