#pragma once
/// All parameters that a run goes by, for those who want to repeat it.

#include "src2d/scene/scene.h"
#include "src2d/trace/json_text.h"

namespace merge2d {

/// An object: gravity, step, duration, seed and every table of settings, defaults included.
void writeParameters(JsonText& out, const Scene& scene);

}  // namespace merge2d
