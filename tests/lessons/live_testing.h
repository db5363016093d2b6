#pragma once
/// A live run of two boxes on each other.

#include "lessons/live.h"
#include "src2d/scene/load.h"

namespace merge2d {

inline Scene stackScene() {
  return parseScene(R"(format = 1
[[body]]
name = "ground"
motion = "pinned"
box = [20, 1]
at = [0, -0.5]
[[body]]
name = "low"
box = [1, 1]
at = [0, 0.5]
[[body]]
name = "high"
box = [1, 1]
at = [0, 1.5]
)",
                    "stack.toml");
}

inline Live stack(Mode mode = Mode::MergeSleep) { return Live(stackScene(), mode); }

}  // namespace merge2d
