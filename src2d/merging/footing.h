#pragma once
/// Whether parts of a collection, each as one body, can stay where they are.

#include <vector>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Welds that cannot hold what they join.
struct Footing {
  std::vector<std::uint32_t> giving;  ///< that take part in the motion; none where all stays
  double speed = 0.0;                 ///< of the part that moves fastest against another [m/s]
  double enough = 0.0;                ///< where none is faster, all stays [m/s]
};

/// Takes parts of the collection as rigid bodies on the contacts between them and with its frame:
/// at first all of it, or what stands on its heaviest member; then what two points join that are
/// not at their limits. Where no forces hold the parts, none hold the members. Asked every few
/// steps, of what the last sweep has left swaying; more seldom under a load between those that were
/// found to be borne, as rigid contacts with friction bear a convex cone of loads.
///
/// Deviation: sweeps take the moment of a high tower down to its foot over thousands of steps, a
/// little between any two bricks, and would hold it long after it had to fall. Whether it stands is
/// a question of a few contacts, and of few bodies. Guarded by
/// Footing.ATowerFallsWhenItsGroundTiltsTooFar.
Footing footingOf(const State& state, Scratch& scratch, Collection& collection);

}  // namespace merge2d
