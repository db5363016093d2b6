#pragma once
/// ContactOrdering: where something new enters in this step (Section 6.2).

#include <cstdint>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Pairs that meet faster than this are an impact: gravity alone does not do it within two steps,
/// so a resting body that lost its contact for a moment is none [m/s].
double impactSpeed(const State& state);

/// ContactOrdering: the bodies at which something is new: a fresh contact that closes in this step,
/// or an impulse.
void orderContacts(State& state, Scratch& scratch);

}  // namespace merge2d
