#pragma once
/// The blocks and bodies of the full solve by island.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Orders the row sources by island and, inside it, by colour: blocks of one colour share no body
/// that moves, so that consecutive ones need not wait for each other's results. Joints unite
/// islands too.
void orderBlocks(const State& state, Scratch& scratch);

/// Lists the bodies of each island, so that its sweeps touch nothing else.
void listIslandBodies(const State& state, Scratch& scratch);

}  // namespace merge2d
