#pragma once
/// Edges inside a body that is made of several shapes: nothing can touch them.
///
/// A box that slides over a floor of tiles dips into it by a hair, and the narrow phase finds the
/// side of the next tile in its way. Such points are told by the matter behind them: on either side
/// of a true contact, along the surface, some of it is open.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Lists for each shape of a body with several those that touch it. Called once, at set-up.
void listSiblings(State& state);

/// Whether a shape's body has others that touch it.
inline bool hasSiblings(const State& state, std::uint32_t shape) {
  return !state.siblings.empty() && state.first_sibling[shape] < state.first_sibling[shape + 1];
}

/// Signed distance of a place from a shape, or less; negative inside [m].
double signedDistance(const Collider& shape, const Vec2& p);

/// Drops the points of a contact that lie on edges inside one of the two bodies.
void dropInternalEdges(const State& state, const Pose& b_in_a, Contact& contact);

}  // namespace merge2d
