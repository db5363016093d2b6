#pragma once
/// A run before the run: the camera needs the area that the bodies will cover.

#include <memory>

#include "render/camera.h"
#include "src2d/world.h"

namespace merge2d {

/// The area that the bodies cover until the scene ends, or until the simulation fails. Throws
/// Interrupted.
Coverage coverageOf(const std::shared_ptr<const Scene>& scene, Mode mode);

}  // namespace merge2d
