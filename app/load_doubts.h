#pragma once
/// Warnings of scenes that ask for more than contacts can bear (docs/limits.md).

#include "src2d/scene/scene.h"

namespace merge2d {

/// Contacts that are at rest soon after the start, and whose load will push the two bodies into
/// each other: with the figure to expect.
void warnOfHeavyLoads(Scene& scene);

/// Bodies so small that they fall by more than their size in a step.
void warnOfSmallBodies(Scene& scene);

}  // namespace merge2d
