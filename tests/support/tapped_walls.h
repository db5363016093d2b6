#pragma once
/// Two walls on a platform at a steady speed. The small one is tapped, so that both are opened: the
/// large one, 2 mm beside it, though nothing hits it.

#include "tests/support/scenes.h"

namespace merge2d {

inline Scene tappedWalls() {
  return sceneOf(R"(
    duration = 2.5
    [[body]]
    name = "platform"
    motion = "scripted"
    at = [0, -0.5]
    box = [120, 1]
    script = { velocity = [1, 0] }
    [[body]]
    name = "a"
    at = [-2.0, 0.25]
    box = [0.5, 0.5]
    velocity = [1, 0]
    repeat = { count = [4, 8], spacing = [0.5, 0.5] }
    [[body]]
    name = "b"
    at = [0.002, 0.25]
    box = [0.5, 0.5]
    velocity = [1, 0]
    repeat = { count = [30, 14], spacing = [0.5, 0.5] }
    [[impulse]]
    body = "a[3,7]"
    time = 2.0
    at = [1.5, 3.75]
    impulse = [-0.1, 0]
  )");
}

}  // namespace merge2d
