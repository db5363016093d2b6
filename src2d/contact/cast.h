#pragma once
/// Contacts that are predicted ahead: whether, where and how two bodies meet in this step.
///
/// A row at the nearest points of now, with the gap of now, pushes bodies that will pass by, and
/// hits with the normal of now. So both bodies are moved through the step as they would move
/// without contacts, by conservative advancement (Mirtich 1996): with n the direction of the
/// shortest way between them, v the velocities of the centres of mass and max|r| the distance from
/// there to the farthest point of a shape, no two points approach faster than
/// −n·(v_b − v_a) + |ω_a| max|r_a| + |ω_b| max|r_b|, so the distance over this bound is a time in
/// which they cannot meet. Where a corner slides along a face, it is short; seen from the body of
/// the face, whose plane stands still there, the times at which the corners of the other can come
/// through that plane are a better bound.
///
/// Where they meet, or else where they are nearest, the manifold is found anew, and its gaps are
/// carried back along w, the relative velocity there: gap − t·w. The row of a hit then closes at
/// the time of the hit; that of a miss does not act on free motion, yet bounds how far other
/// contacts can push the two into each other.
///
/// A row acts on both bodies at one place of now, or it would change their angular momentum: that
/// of the point on the first body. By the time of the hit the second has moved across; where that
/// matters, dynamics/hits.h lets both move there.

#include "src2d/dynamics/casts.h"

namespace merge2d {

/// A contact at which two bodies meet in this step without restitution, as it is then.
struct SoftHit {
  Contact contact;
  Cast cast;
};

/// Replaces the points of a contact that is open, but would close in this step, by those of the
/// meeting or of the nearest approach. Without forces the two come nearer by `ahead` [m] at most.
/// A member of a collection moves with all of it until then, also where it comes free in this step.
/// Appends to `scratch.casts`; a meeting without restitution goes to `soft` instead, and leaves the
/// contact as it is: contact/followed_hits.h decides.
void castContact(const State& state, Scratch& scratch, Contact& contact, double ahead,
                 std::vector<SoftHit>& soft);

/// Makes the casts of this step ready for `castOf`.
void sortCasts(Scratch& scratch);

}  // namespace merge2d
