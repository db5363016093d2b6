#pragma once
/// Warnings of scenes that ask for more than contacts and joints can bear (docs/limits.md).

#include "src2d/scene/scene.h"

namespace merge2d {

/// Contacts whose load, or a blow, pushes two bodies into each other by more than 2 % of the
/// smaller one, or 2 cm, up to 3 s after the last impulse comes, force sets in, or body is let go
/// (100 steps at least, less where bodies are many): with the figure to expect. Joints that loads
/// pull open in that time (joint_watch.h).
void warnOfHeavyLoads(Scene& scene);

/// Bodies so small that they fall by more than their size in a step.
void warnOfSmallBodies(Scene& scene);

}  // namespace merge2d
