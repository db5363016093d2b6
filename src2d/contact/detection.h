#pragma once
/// ContactDetection, the first stage of Algorithm 1.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Finds all contacts between different rigid things and carries the impulses of those that last.
/// Reads poses; writes the contact table, the broadphase and `scratch.pairs`.
void detectContacts(State& state, Scratch& scratch);

/// Computes one contact's manifold from the current poses, keeping what is remembered of points
/// whose features are still there. Points count up to the solver's margin apart, or as far as the
/// two come nearer in this step, `ahead` [m].
void updateManifold(const State& state, Contact& contact, double ahead);

/// Lists the body pairs that have a contact point, ascending.
void collectPairs(const State& state, Scratch& scratch);

/// Brings the contact table into the one form that its contents have, however they came to be.
void settleContacts(State& state, Scratch& scratch);

/// Two well-spread points per flat region of a pair of bodies: keeps the outermost two of each
/// group of points with one normal and in one line, over all shape contacts of the pair, and what
/// is nearer than these would let it. Guarded by Pruning.AToothThatIsALittleLongerBears.
void prunePair(ContactTable& table, const BodyPair& pair, PruneMemory& memory);

}  // namespace merge2d
