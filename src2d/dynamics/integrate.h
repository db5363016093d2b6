#pragma once
/// AdvanceVelocities and AdvancePositions: symplectic Euler, Eq. (8).

#include "src2d/dynamics/state.h"

namespace merge2d {

/// u₊ of the solve becomes the velocity; `gained` is the change.
void advanceVelocities(State& state, Scratch& scratch);

/// x₊ = x₋ + h u₊, and the correction of post-step stabilisation; anchored collections follow their
/// frames.
void advancePositions(State& state, Scratch& scratch);

}  // namespace merge2d
