#pragma once
/// Sweeps that change little and leave much.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Many sweeps at once over the contacts of a small collection that nothing disturbs, where those
/// that hold are still left in motion: ever less often while nothing new comes in. Returns whether
/// it did so; then each member's push is to be computed anew. Deviation: beside the single sweep of
/// Section 6.2, which in a frame of posts and beams takes a push to the ground over hundreds of
/// steps, and seems to be done long before. Guarded by SlowSweep.AFrameThatIsPushedFallsInTime.
bool hastenSweeps(const State& state, Collection& collection, Scratch& scratch);

}  // namespace merge2d
