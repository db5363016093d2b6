#pragma once
/// Expected contacts: those that a struck member can close with others of its own collection.
/// Detection does not look for contacts there (Section 4.1), as nothing moves; but an impulse moves
/// a member within the very step, and without these contacts it would pass through a neighbour that
/// it does not touch yet. Deviation: the paper has no such contacts. Guarded by
/// ExpectedContacts.ABodyPushesANeighbourThatItDoesNotTouchYet.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Adds the contacts that members with an impulse in this step can close: to their collections, for
/// the sweep, and towards bodies that are fixed to the same frame. They are no welds.
void expectContactsOfStruck(State& state, Scratch& scratch);

/// Forgets those that are still inside a collection when all welds have been tested.
void forgetExpectedContacts(State& state, const Scratch& scratch);

}  // namespace merge2d
