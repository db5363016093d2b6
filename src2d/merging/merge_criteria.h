#pragma once
/// The merge criteria of one pair of bodies in contact (Section 5), as pure functions. A rule names
/// those that it asks (rule.h).

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Two bodies in contact, with extremes over their contacts.
struct PairInContact {
  const State& state;
  const BodyPair& pair;
  int active = 0;               ///< contact points that carry a force
  double fastest_slip = 0.0;    ///< of active points [m/s]
  double largest_breath = 0.0;  ///< change of the overlap since the last step [m]
  int on_edge = 0;              ///< active points at the limit of their cone
  double scale = 1.0;           ///< on the thresholds, by the size of the bodies
};

PairInContact lookAt(const State& state, const BodyPair& pair);

/// Criteria are asked about two bodies that are awake, and not on two frames.
bool isWatched(const State& state, BodyId one, BodyId other);

/// A body on a belt moves, however slowly [m/s].
Criterion isNotCarried(const State& state, BodyId one, BodyId other);

/// The impulse of a contact in this step, along its normal and tangent [N s].
Vec2 impulseOf(const Contact& contact);

using PairCriterion = Criterion (*)(const PairInContact& pair);

/// Some contact carries a force; where none does, nothing else is asked.
Criterion pressed(const PairInContact& pair);

/// Eq. (18).
Criterion slidesSlowly(const PairInContact& pair);

/// "Let it breathe" (Section 5.3).
Criterion hardlyBreathes(const PairInContact& pair);

/// The contacts are not all on the edge of their cones, Eq. (20), or the bodies are wedged in.
/// Guarded by Merge.APairOnTheEdgeOfItsConeWaits.
Criterion isNotAboutToSlide(const PairInContact& pair);

/// The impulse between the bodies hardly changes. Guarded by
/// Merge.APairWaitsUntilItsImpulseHasSettled.
Criterion hasSettledLoad(const PairInContact& pair);

/// Eqs. (15) to (17).
Criterion movesAsOne(const PairInContact& pair);

}  // namespace merge2d
