#pragma once
/// Unmerge of `unmerging.rule = "default"`. Deviations (docs/decisions/cures.md), each with its
/// test in tests/src2d/merging/unmerge_test.cpp:
/// – slip and opening are summed over consecutive steps before they are compared with the
///   threshold: a sweep's velocity is thrown away each step, so a single one only sees
///   accelerations above ε/h;
/// – after a cut, bodies that stay together must be a rigid group, not merely connected.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Tests all welds of swept collections, looks again after more sweeps where something would part,
/// and splits those that fall apart.
void unmergeConfirmed(State& state, Scratch& scratch);

}  // namespace merge2d
