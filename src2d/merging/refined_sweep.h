#pragma once
/// SingleIterationPGS of `unmerging.rule = "default"`: one sweep, and more where something is new.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Sweeps the contacts of each collection once, then goes on where something is new or still
/// changes much (refine.h).
void sweepRefined(State& state, Scratch& scratch);

/// More sweeps in one collection and at the contacts outside, from the bodies in `scratch.doubted`
/// on, before one of its welds is cut.
void sweepAgain(State& state, Scratch& scratch, Collection& collection);

}  // namespace merge2d
