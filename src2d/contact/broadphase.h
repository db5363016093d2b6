#pragma once
/// Which shapes may touch: two levels. One tree holds a leaf per rigid thing; each rigid thing with
/// several shapes (a compound body, a collection) has a tree of its shapes in its own frame, which
/// never changes while it moves (Section 4.1).

#include "src2d/contact/approach.h"
#include "src2d/dynamics/state.h"

namespace merge2d {

/// Puts a rigid thing into the broadphase, or takes it out. Its shapes' tree is not touched.
void insertRigid(State& state, RigidId id);
void removeRigid(State& state, RigidId id);

/// Builds the tree of the shapes of a rigid thing, if it has more than one; `bodies` are its
/// members (the body itself for a body).
void addShapes(State& state, RigidId id, const std::vector<BodyId>& bodies);
void removeShapes(State& state, RigidId id, const std::vector<BodyId>& bodies);
void dropShapeTree(State& state, RigidId id);

/// Builds the tree anew, with the boxes that it had.
void rebuildTree(State& state);
/// The same when most of its leaves have gone.
void compactTree(State& state);

/// Follows the motion of all rigid things and brings the contact table up to date with the pairs of
/// shapes whose boxes meet: pairs that parted are dropped, new ones start idle.
void updateBroadphase(State& state, Scratch& scratch, const Approaches& approaches);

}  // namespace merge2d
