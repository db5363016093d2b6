#pragma once
/// A run that a lesson shows.

#include <cstddef>
#include <string>

#include "src2d/scene/scene.h"

namespace merge2d {

/// The first one is shown at the start. Others run the same scene in another way, for "what if?",
/// or another scene, which parts of the lesson are about.
struct LessonTrace {
  std::string label;
  Mode mode = Mode::MergeSleep;
  Scene scene;
  std::string scene_name;  ///< as the lesson names it: a file of its folder, or a built-in scene
  std::size_t world = 0;   ///< the same for runs of the same scene
};

}  // namespace merge2d
