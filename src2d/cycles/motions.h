#pragma once
/// The infinitesimal motions that a set of pins leaves, from the rank of its Jacobian.

#include <span>

#include "src2d/cycles/pins.h"

namespace merge2d {

/// The maximal groups of nodes that the pins *between them* hold together where they are placed;
/// all pins must be. Each pin p of nodes a and b asks for equal velocities there,
///     v_a + ω_a × p − v_b − ω_b × p = 0:
/// two rows of the Jacobian J. Lengths are divided by the size of each node, so that the tolerance
/// of the rank (cycles/tolerance.h) does not depend on units. Where J's rank is not full, nodes
/// that turn alike in a random motion of its null space may be held together; they are tested again
/// on their own, since others may have helped to hold them.
Groups placedGroups(std::uint32_t nodes, std::span<const Pin> pins, double resolution);

}  // namespace merge2d
