#pragma once
/// Reasons for doubt: the loads and hits of a step for which no proof is known that the contacts
/// inside a collection carry them.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// WarmStart: sets `scratch.doubts` for each collection, and begins searches for loads that no
/// proof covers.
void findDoubts(State& state, Scratch& scratch);

}  // namespace merge2d
