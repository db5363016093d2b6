#pragma once
/// SingleIterationPGS (Section 6.2): one sweep of PGS over the contacts inside
/// collections, and those around them, keeps the inner forces alive. Its velocities are only looked
/// at, by Unmerge; its impulses of contacts outside collections are thrown away, so that the full
/// solve's warm start is untouched.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Sweeps. Collections that are not disturbed: once, by colours. Disturbed ones: breadth first from
/// the seeds, `unmerging.disturbed_sweeps` times.
void sweepCollections(State& state, Scratch& scratch);

/// More sweeps over one collection and the contacts outside, before one of its welds is cut:
/// `unmerging.disturbed_sweeps` of them.
void sweepAgain(State& state, Scratch& scratch, Collection& collection);

/// Velocities below this are what a sweep leaves for the next one: a thousandth of what gravity
/// adds in a step [m/s].
double residualVelocity(const State& state);

/// True for a collection whose inner forces are swept in this step.
bool isSwept(const State& state, const Collection& collection);

}  // namespace merge2d
