#pragma once
/// Writes down which rigid group holds a pair that is to merge, and which one came apart when a
/// weld goes that nothing has cut.

#include "src2d/cycles/pins.h"
#include "src2d/dynamics/state.h"
#include "src2d/merging/ready_pairs.h"

namespace merge2d {

/// For each ready pair the group that holds it, if any does. `group` is empty when nothing was
/// judged.
void noteGroups(const State& state, Scratch& scratch, const Groups& group);

/// For each weld that ended without being cut the group that it was part of: all parts that were
/// welded to each other `before`, in the welds that ended. Nothing when nobody asks.
void noteBrokenGroups(const State& state, const Collection& before, Notes* notes);

/// True when the two bodies of a weld are still one rigid thing, or on one frame.
bool stillTogether(const State& state, BodyId a, BodyId b);

}  // namespace merge2d
