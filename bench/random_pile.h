#pragma once
/// A pile that is different for each seed.

#include <cstdint>

#include "src2d/scene/scene.h"

namespace merge2d {

/// Discs, boxes and triangles that fall into a pit.
Scene randomPile(std::uint64_t seed, int bodies, int columns);

}  // namespace merge2d
