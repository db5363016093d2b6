#pragma once
/// Settings that are allowed but seldom meant: each adds to the warnings of the scene.

#include "src2d/scene/scene.h"

namespace merge2d {

/// Bodies that overlap from the start jump apart.
void warnOfOverlaps(Scene& scene);

/// Impulses, forces, magnets and emitters whose time the scene's duration does not reach.
void warnOfWhatComesTooLate(Scene& scene);

/// Bodies that fly or spin faster than is likely to be meant: by a script, at the start, or out of
/// an emitter.
void warnOfHaste(Scene& scene);

/// Entries without effect: scripts that never move their body, the mass of a pinned body, and
/// springs, forces and impulses of zero.
void warnOfWhatDoesNothing(Scene& scene);

/// Merging and unmerging by two rules.
void warnOfMixedRules(Scene& scene);

/// Joints that begin outside their limits, or with another length than their own: they pull at
/// once.
void warnOfStrainedJoints(Scene& scene);

}  // namespace merge2d
