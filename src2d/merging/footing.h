#pragma once
/// Whether a model of a few rigid parts of a collection is in equilibrium.

#include <vector>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Welds that cannot hold the parts that they join.
struct Footing {
  std::vector<std::uint32_t> giving;  ///< that take part in the motion; none where all stays
  double speed = 0.0;                 ///< of the part that moves fastest against another [m/s]
  double enough = 0.0;                ///< where none is faster, all stays [m/s]
};

/// Takes parts of the collection as rigid bodies on the contacts between them and with its frame:
/// first the whole, or all members that stand on the heaviest one; then the groups joined by two
/// points that are not at their limits. Where no forces hold the parts, none hold the members.
/// Asked every few steps, where the last sweep has left members swaying; less often under loads
/// between those that were found to be borne, as rigid contacts with friction bear a convex cone of
/// loads.
///
/// Deviation: sweeps take the moment of a high tower down to its foot over thousands of steps, a
/// little between any two bricks, and would hold it long after it had to fall. A model of a few
/// bodies and contacts decides at once whether it stands. Guarded by
/// Footing.ATowerFallsWhenItsGroundTiltsTooFar.
Footing footingOf(const State& state, Scratch& scratch, Collection& collection);

}  // namespace merge2d
