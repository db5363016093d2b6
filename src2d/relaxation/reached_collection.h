#pragma once
/// A collection that is fixed to a frame and rests against something free. Where that is hit, also
/// through others, the blow must not end in the frame: the full solve takes the collection as
/// immovable, and tells how much it would have to bear.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Something that a collection touches was hit.
inline constexpr Criterion kNeighbourHit{"neighbour-hit", kOwnDecided, 1.0, 0.0, false};

/// Its region before the solve: nothing is open. The loads from outside must be listed.
void beginReached(const State& state, const Scratch& scratch, const Collection& c,
                  OpenRegion& region);

/// After the solve: opens it where its proofs do not cover that load, and contacts cannot pass it
/// on to the frame. True where the step must be solved again. The loads from outside must be listed
/// again.
bool openReached(State& state, Scratch& scratch, OpenRegion& region);

}  // namespace merge2d
