#pragma once
/// The sources of the blocks of the full solve: contacts between rigid things, and those inside
/// collections that are open.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Fills `scratch.row_sources`, in the order of the pairs. The start velocities must be known.
void listRowSources(const State& state, Scratch& scratch);

/// The two rigid things, or members of open collections, that a block acts on.
struct RowEnds {
  RigidId a{}, b{};
};
RowEnds endsOf(const State& state, const Scratch& scratch, const RowSource& source);

}  // namespace merge2d
