#pragma once
/// What a scene may say, but is seldom meant: each adds to the warnings of the scene.

#include "src2d/scene/scene.h"

namespace merge2d {

/// Bodies that overlap from the start jump apart.
void warnOfOverlaps(Scene& scene);

/// Impulses, forces, magnets and emitters whose time the scene's duration does not reach.
void warnOfWhatComesTooLate(Scene& scene);

}  // namespace merge2d
