#pragma once
/// Unmerge (Sections 6.3 and 6.4): cuts welds and splits the collections that fall apart without
/// them. The rule decides which welds are cut (rule.h).

#include <vector>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Cuts welds of swept collections and splits those that fall apart.
void unmerge(State& state, Scratch& scratch);

/// Cuts all welds of some bodies: their pinning ended, or the user wants it.
void releaseBodies(State& state, Scratch& scratch, const std::vector<BodyId>& bodies);

}  // namespace merge2d
