#pragma once
/// A collection that a blow reaches through something else: a body that rests against it is hit, or
/// a rope that holds it becomes taut. The blow must not end in its frame, nor move all of its
/// members as one: the full solve takes the collection as one body, and tells how much it would
/// have to bear.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Something that a collection touches was hit.
inline constexpr Criterion kNeighbourHit{"neighbour-hit", kOwnDecided, 1.0, 0.0, false};

/// Its region before the solve: nothing is open. The loads from outside must be listed.
void beginReached(const State& state, const Scratch& scratch, const Collection& c,
                  OpenRegion& region);

/// After the solve: opens it where its proofs do not cover that load, and contacts cannot pass it
/// on to the frame; one that floats where the blow also moves it faster than an impact is. True
/// where the step must be solved again. The loads from outside must be listed again.
bool openReached(State& state, Scratch& scratch, OpenRegion& region);

}  // namespace merge2d
