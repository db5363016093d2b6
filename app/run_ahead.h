#pragma once
/// A run before the run: to see what will be seen.

#include <memory>

#include "render/camera.h"
#include "src2d/world.h"

namespace merge2d {

/// What the bodies cover until the scene ends, or until the simulation fails. Throws Interrupted.
Coverage coverageOf(const std::shared_ptr<const Scene>& scene, Mode mode);

}  // namespace merge2d
