#pragma once
/// Unmerge (Sections 6.3 and 6.4): which welds the sweep found broken, sliding or moving, and what
/// falls apart without them.
///
/// Deviations under `unmerging.rule = "default"` (docs/decisions/cures.md), each with its test in
/// tests/src2d/merging/unmerge_test.cpp:
/// – slip and opening are summed over consecutive steps before they are compared with the
///   threshold: a sweep's velocity is thrown away each step, so a single one only sees
///   accelerations above ε/h;
/// – after a cut, what remains together must be rigid, not merely connected.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Tests all welds of swept collections and splits those that fall apart.
void unmerge(State& state, Scratch& scratch);

/// Cuts all welds of one body: its pinning ended, its magnet changed, or the user wants it.
void releaseBody(State& state, Scratch& scratch, BodyId body);

}  // namespace merge2d
