#pragma once
/// Whether the parts that cuts would free would move at all, asked before they are freed.

#include <optional>
#include <span>
#include <vector>

#include "src2d/merging/parts.h"

namespace merge2d {

/// The split of one collection that the tests of this step ask for.
struct Proposal {
  RigidId rigid{};
  Parts parts;
  bool sure = false;  ///< all its parts move, even where the trial finds none
};

/// Solves the contacts of all parts but the largest of each collection as if they were free
/// already; the largest is rigid, as it will be in this step. A part that would not move stays, and
/// the evidence against its welds is forgotten. Returns per proposal the parts that are left of it,
/// or nothing. Deviation: in the sweep all members move on their own, so that a blow makes its
/// whole surroundings slip a little, of which nothing is left when most of them move as one.
/// Guarded by Trial.WhatWouldNotMoveStays. All proposals of a step are tried at once, or a blow
/// that goes through several collections would stop at the next one. Guarded by
/// Trial.ABlowGoesThroughNeighboursThatPartInTheSameStep.
std::vector<std::optional<Parts>> partsThatMove(State& state, Scratch& scratch,
                                                std::span<const Proposal> proposals);

/// Lets welds hold that were cut or lost contacts since that was last judged, but for those at
/// bodies that this step jolted; the sums against them stay. Returns true when none is left.
bool withholdCuts(const State& state, Collection& c);

}  // namespace merge2d
