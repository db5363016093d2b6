#pragma once
/// Hits: bounces, and the hits that they set off, at the times in the step at which they happen.
///
/// A row can end an approach, but not turn it into a bounce: the step's velocities would have to
/// bring the bodies together and apart. So a point that is about to bounce takes no part in the
/// full solve. From its velocities on, the bodies of the island move in straight lines from hit to
/// hit. The normal of a disc turns on any way; so where one meets is found from where it is then.
/// At each hit, Newton's law w⁺ = −e w⁻ holds at the points that have met and approach, pair by
/// pair: an approach that these cause at contacts that touch already is a further hit at the same
/// time, so that of a row of balls only the last one leaves. Contacts without restitution, slow
/// ones, and rigid joints hold meanwhile (w⁺ ≥ 0, w⁺ = w⁻), as do points without restitution and
/// limits of joints after their own hit. Where hits have no end, the later ones of the step are
/// plastic. The velocities after the last hit are those of the bodies; the way that they went is
/// kept apart (Scratch::hit_ways).
///
/// Source: Newton's law at simultaneous contacts as generalised reflections, Smith, Kaufman, Vouga,
/// Tamstorf, Grinspun 2012. The energy of hits never grows: the gain by friction at an oblique one
/// (Kane's paradox) is taken back by weakening the impulses.
///
/// The velocities of the symplectic Euler scheme are those in the middle of a step. With α the
/// acceleration of the approach by loads, a hit at time t happens at s + α(t − h/2), and its bounce
/// is kept as that speed times e, plus α(t − h/2): then a ball that bounces with e = 1 rises to
/// where it fell from at any h.
///
/// Without restitution hits are followed in small islands alone (contact/followed_hits.h).
///
/// Guarded by tests/src2d/dynamics/hits_test.cpp, jammed_hits_test.cpp, joint_hits_test.cpp,
/// point_impact_test.cpp and restitution_test.cpp.

#include "src2d/dynamics/hit_rows.h"

namespace merge2d {

/// Follows the hits of an island through the step, from the velocities of the full solve on.
void resolveHits(State& state, Scratch& scratch, const Island& island);

/// How a rigid thing goes through the step: as hits left it (Scratch::hit_ways), or else with the
/// velocity that it has now.
HitWay wayInStep(const State& state, const Scratch& scratch, RigidId id);

}  // namespace merge2d
