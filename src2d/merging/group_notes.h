#pragma once
/// Writes down which rigid group holds a pair that is to merge.

#include "src2d/cycles/pins.h"
#include "src2d/dynamics/state.h"
#include "src2d/merging/ready_pairs.h"

namespace merge2d {

/// For each ready pair the group that holds it, if any does. `group` is empty when nothing was
/// judged.
void noteGroups(const State& state, Scratch& scratch, const Groups& group);

}  // namespace merge2d
