#pragma once
/// Whether what a cut would free would move at all, before it is freed.

#include <optional>

#include "src2d/merging/parts.h"

namespace merge2d {

/// Solves the contacts of all parts but the largest as if they were free already, the largest and
/// other collections being rigid, as they will be in this step. A part that would stay where it is
/// stays, and what was found against it is forgotten. Deviation: in the sweep all members move on
/// their own, so that a blow makes its whole surroundings slip a little, of which nothing is left
/// when most of them move as one. Guarded by Trial.WhatWouldNotMoveStays.
std::optional<Parts> partsThatMove(State& state, Scratch& scratch, Collection& c,
                                   const Parts& parts);

/// Lets all welds hold that were cut or lost contacts since that was last judged; what was summed
/// against them stays.
void withholdCuts(const State& state, Collection& c);

}  // namespace merge2d
