#pragma once
/// Worlds of a few bodies and joints, written as text.

#include <string>

#include "tests/support/scenes.h"

namespace merge2d {

/// A world without gravity's ground: bodies and joints alone.
inline World running(const std::string& toml, Mode mode = Mode::Reference) {
  return World(parseScene("format = 1\n" + toml, "test.toml"), {.mode = mode, .timings = false});
}

inline BodyState body(const World& world, const std::string& name) {
  return world.capture().bodies[index(idOf(world, name))];
}

inline void run(World& world, double time) {
  while (world.time() < time - 1e-9) world.step();
}

}  // namespace merge2d
