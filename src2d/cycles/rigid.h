#pragma once
/// The general criterion: a group of bodies is rigid when its contacts, taken as pins, leave no
/// relative freedom.

#include <span>

#include "src2d/cycles/pins.h"

namespace merge2d {

/// The maximal rigid groups: those of `genericGroups`, and within these, where pins are placed,
/// those that are rigid where they are. Pins that are not placed count as in general position.
Groups rigidGroups(std::uint32_t nodes, std::span<const Pin> pins);

}  // namespace merge2d
