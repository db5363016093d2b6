#pragma once
/// Collections: bodies simulated as one (Section 4). Forming them, taking them apart, and keeping
/// the contacts inside them.
///
/// Deviation: pinned and scripted bodies are never members. A collection welded to one is fixed to
/// its frame ("anchored"), so that two piles on one floor stay two collections, which split and
/// sleep on their own. Guarded by Collection.TwoPilesOnOneFloorStayTwo.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Eqs. (10)-(14): `c` takes over mass, inertia and momentum of `b`; its frame stays where it is.
void addMotion(Rigid& c, const Rigid& b);

/// Joins two floating or anchored rigid things, of which at least one floats or which share a
/// frame; the larger part keeps its id. Returns the collection.
RigidId mergeRigids(State& state, RigidId a, RigidId b);

/// Fixes a rigid thing to the frame of the pinned or scripted body `anchor`.
RigidId anchorRigid(State& state, RigidId id, BodyId anchor);

/// Takes all contacts between bodies of one collection, or of one with its frame, out of the
/// contact table into that collection.
void absorbContacts(State& state);

/// Mass, centre, inertia and bounds of a collection from its members; momentum is not touched.
void gatherMass(State& state, RigidId id);

/// Makes welds, blocks and boxes anew of all collections whose contacts changed.
void layOutCollections(State& state);

/// The same for floating collections and those with proofs: the solver needs nothing of the other
/// anchored ones, which may change once more before the next sweep.
void layOutFloating(State& state);

/// Lists the welds of each member. A layout leaves that empty, and the first reader calls this.
void listWeldsOfMembers(Collection& collection);

/// Takes the collection apart: `part[i]` is the part of its i-th member, `anchored[p]` says whether
/// part p is still welded to the frame. The largest part keeps id and frame; contacts between the
/// parts return to the contact table with their impulses. Momentum is conserved to rounding.
/// Returns the rigid things that came out, the largest first.
std::vector<RigidId> splitCollection(State& state, RigidId id,
                                     const std::vector<std::uint32_t>& part,
                                     const std::vector<std::uint8_t>& anchored);

/// Takes a contact's impulses out of its block, which no longer fits.
void dropBlock(const Collection& collection, InternalContact& contact);

/// Gives back the memory of blocks inside which nothing is sought for now; the impulses stay with
/// the contacts. Guarded by Layout.BlocksThatWerePutAwayComeBackAsTheyWere.
void putBlocksAway(Collection& collection);
/// Makes them anew, in their order.
void bringBlocksBack(const State& state, Collection& collection);

/// Makes room for that many collections more at once.
void reserveCollections(State& state, std::size_t more);
/// A new, empty collection that has neither place nor members yet.
RigidId newCollection(State& state);
/// Gives it the place and the motion of a rigid thing that it takes over from, or is a part of.
void takeMotion(State& state, RigidId id, const Rigid& of);
/// Gives the slot back; its rigid thing must have left the broadphase.
void freeCollection(State& state, RigidId id);
/// Shortens the tables where the last slots are free.
void dropFreeSlots(State& state);

/// True for a collection whose inner forces may be sought in this step: it is there and awake.
bool isSwept(const State& state, const Collection& collection);

/// The frame that a pinned or scripted body belongs to.
FrameId frameOf(const State& state, BodyId body);

}  // namespace merge2d
