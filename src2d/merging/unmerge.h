#pragma once
/// Unmerge (Sections 6.3 and 6.4): cuts welds and splits the collections that fall apart without
/// them. The rule decides which welds are cut (rule.h).

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Cuts welds of swept collections and splits those that fall apart.
void unmerge(State& state, Scratch& scratch);

/// Cuts all welds of one body: its pinning ended, its magnet changed, or the user wants it.
void releaseBody(State& state, Scratch& scratch, BodyId body);

}  // namespace merge2d
