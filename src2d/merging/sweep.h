#pragma once
/// SingleIterationPGS (Section 6.2): one sweep of PGS over the contacts inside
/// collections, and those around them, keeps the inner forces alive. Its velocities are only looked
/// at, by Unmerge; its impulses of contacts outside collections are thrown away, so that the full
/// solve's warm start is untouched.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Sweeps the contacts of each collection once, then goes on where something is new or still
/// changes much (merging/refine.h). `unmerging.rule = "paper"`: everything once, breadth
/// first from the seeds, and no more.
void sweepCollections(State& state, Scratch& scratch);

/// More sweeps in one collection and at the contacts outside, from the bodies in `scratch.doubted`
/// on, before one of its welds is cut.
void sweepAgain(State& state, Scratch& scratch, Collection& collection);

/// Computes anew what the inner forces do to members, where more sweeps have changed them: once in
/// a step, and not where all is laid out anew.
void renewPushes(State& state, Scratch& scratch);

/// True for a collection whose inner forces are swept in this step.
bool isSwept(const State& state, const Collection& collection);

}  // namespace merge2d
