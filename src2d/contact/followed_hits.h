#pragma once
/// Hits without restitution that are followed through the step (dynamics/hits.h).
///
/// They are followed in small islands alone, as all contacts that bear take part in each; in others
/// the contact stays where it is now, and the full solve ends the approach. An island has the size
/// that it has in the reference: collections count their pairs, and sleepers count as awake.

#include <span>

#include "src2d/contact/cast.h"

namespace merge2d {

/// Puts the contacts of those hits of `soft` that are followed where the bodies will meet, and adds
/// their casts to `scratch.casts`. All contacts of the step are in the table. Guarded by
/// FollowedHits.AHairOfSpinChangesNothing.
void followSoftHits(State& state, Scratch& scratch, std::span<const SoftHit> soft);

}  // namespace merge2d
