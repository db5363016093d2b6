#pragma once
/// `rule = "paper"`: Sections 5 to 7 of the paper to the letter. Besides paper_rule.cpp,
/// paper_unmerge.cpp, paper_floors.cpp and paper_sleep.cpp it uses only the parts that every rule
/// shares; docs/decisions/cures.md says where it goes wrong in the plane.

#include "src2d/merging/rule.h"

namespace merge2d {

extern const MergingMethod kPaperMerging;
extern const UnmergingMethod kPaperUnmerging;

/// Section 6.2: one sweep over all contacts of merged and free bodies, breadth first from the seeds
/// where there are any.
void sweepBreadthFirst(State& state, Scratch& scratch);

/// Sections 6.3 and 6.4: cuts the welds with a contact that is broken or slides, and those that
/// turn; splits each collection into the components of the welds that are left.
void unmergeByContacts(State& state, Scratch& scratch);

/// Welds pairs, and makes one collection of all that is welded to one floor.
void weldPairsAndFloors(State& state, Scratch& scratch, const std::vector<BodyPair>& pairs);

/// All members that are welded to one body of a frame are one part.
void uniteOnFloors(const Collection& c, PartFinder& finder);

/// The connected components of the remaining welds that have an active contact or a joint.
Parts connectedParts(const State& state, const Collection& c);

/// Section 7: each body and each collection sleeps, and wakes, by itself.
void sleepEachByItself(State& state, Scratch& scratch);

}  // namespace merge2d
