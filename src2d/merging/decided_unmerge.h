#pragma once
/// Unmerge of `unmerging.rule = "decided"`: after the full solve with open collections, the welds
/// whose bodies move are cut, and where none does, the load is remembered as carried. Deviation
/// from Sections 6.3 and 6.4, which decide from one sweep. Guarded by tests/src2d/merging/
/// decided_unmerge_test.cpp.

#include "src2d/dynamics/state.h"

namespace merge2d {

void unmergeMovers(State& state, Scratch& scratch);

}  // namespace merge2d
