#pragma once
/// The derived data of a collection: mass, boxes, welds and the blocks of its sweep.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// A member's own box, seen in its collection's frame.
Aabb memberBounds(const State& state, BodyId member);

/// The oriented box of all members (Section 5.2). The motion of an anchored collection is never
/// asked for, so any box will do there.
void fitBox(State& state, RigidId collection);

/// The rows of a contact inside, with its impulses.
ContactBlock innerBlock(const State& state, const Collection& collection,
                        const InternalContact& contact);

/// Where a few bodies have joined a large collection with proofs since its last layout, and nothing
/// has left: puts the new members, contacts, welds and blocks behind the others, which keep their
/// places, at little more than the cost of the new ones. While a collection forms it has no proofs,
/// and all its blocks are in the order of a sweep; later it is laid out as a whole once more than a
/// part of it stands behind. False where that is so; the layout is as it was then. Its impulses
/// must stand in the blocks.
bool layOutGrowth(State& state, Collection& collection);

}  // namespace merge2d
