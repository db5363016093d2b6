#pragma once
/// Which welds of single contacts are stable (Section 8.2). In 2D one contact between two bodies is
/// a pivot; it holds only as part of a group that is rigid as a whole. docs/cycles.md states the
/// criteria; src2d/cycles decides them.

#include <cstdint>
#include <span>

#include "src2d/cycles/pins.h"
#include "src2d/scene/settings.h"

namespace merge2d {

/// Groups of nodes that hold together by one pin per active contact; those of one pair of nodes
/// should stand in a row. `Off`: the connected components.
Groups heldGroups(std::uint32_t nodes, std::span<const Pin> pins, CycleCriterion criterion);

}  // namespace merge2d
