#pragma once
/// Merge (Section 5).
///
/// Deviation under `merging.rule = "default"`: a pair with a contact on the edge of its friction
/// cone is not ready (it is about to slide), and a pair with a single contact is welded only as
/// part of a rigid group. Guarded by tests/src2d/merging/merge_test.cpp.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Welds the pairs that were ready for `merging.steps` steps.
void merge(State& state, Scratch& scratch);

/// The full solve has become smaller: its memory goes back.
void releaseRows(State& state, Scratch& scratch);

/// Gives back the memory that only opened collections need, where none was opened for more than
/// `kept` steps. Returns whether it did.
bool releaseOpenRows(const State& state, Scratch& scratch, int kept);

}  // namespace merge2d
