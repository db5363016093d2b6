#pragma once
/// Merge (Section 5).
///
/// Deviation under `merging.rule = "default"`: a pair with a single contact is welded only as part
/// of a rigid group. Guarded by Merge.ADiscOnTheFloorIsNotWeldedAlone.

#include <functional>
#include <vector>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Welds the pairs that were ready for `merging.steps` steps.
void merge(State& state, Scratch& scratch);

/// Welds each pair, unless its bodies are fixed to two frames. Collections on one floor stay apart
/// (collection.h).
void weldPairs(State& state, Scratch& scratch, const std::vector<BodyPair>& pairs);
/// Also calls `on_floor` for each weld to a body of a frame.
using OnFloor = std::function<void(BodyId floor, BodyId member)>;
void weldPairs(State& state, Scratch& scratch, const std::vector<BodyPair>& pairs,
               const OnFloor& on_floor);

/// The full solve has become smaller: its memory goes back.
void releaseRows(State& state, Scratch& scratch);

/// Gives back the memory that only opened collections need, where none was opened for more than
/// `kept` steps. Returns whether it did.
bool releaseOpenRows(const State& state, Scratch& scratch, int kept);

}  // namespace merge2d
