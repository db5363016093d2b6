#pragma once
/// Proofs that the contacts inside a collection carry the load on its members.
///
/// In a collection's frame the load on a member at rest there is linear in five numbers (FrameLoad)
/// and in the forces that act on it from outside. Admissible impulses (Eqs. (2)-(7)) form a convex
/// cone, and equilibrium is linear: a load that is a non-negative combination of loads that were
/// carried is carried by the same combination of their impulses.

#include "src2d/proofs/collection_load.h"

namespace merge2d {

/// Of a floating collection: the member whose rows follow from those of the others.
BodyId heaviestOf(const State& state, const Collection& c);

/// Marks all proofs as inherited by a new layout of this step, and ends the search.
void restart(const State& state, LoadCertificate& proof);

/// The impulses inside are from now on those of this combination of the proofs.
void carryBy(Collection& c, const LoadCertificate::Weights& weights);

/// The load as a witness that has no impulses yet.
Witness asWitness(const State& state, Collection& c, const CollectionLoad& load);

/// A load as far beyond this one, seen from the mean of the witnesses, as `part` of its distance,
/// with the impulses of this one. `way`: how far that is [m/s].
Witness beyond(const LoadCertificate& proof, const Witness& load, double part, double& way);

/// The velocity that the load gives one member, in the collection's frame.
Twist loadOnMember(const State& state, const Collection& c, const Witness& load,
                   std::uint32_t member);

/// Keeps a witness.
void remember(const State& state, Collection& c, Witness&& witness);

/// The impulses inside are those of the latest proof: it carries loads like that one from now on.
void carryByLatest(Collection& c);

/// Drops all proofs, and has others sought for any load.
void forgetProofs(Collection& c);

}  // namespace merge2d
