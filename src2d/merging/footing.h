#pragma once
/// Whether a collection, as one body, can stay on the frame that it is fixed to.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// What a collection would gain in this step against the frame that it is fixed to.
struct Footing {
  double speed = 0.0;   ///< of the farthest corner of its box [m/s]
  double enough = 0.0;  ///< what is slower stays [m/s]

  bool gives() const { return speed > enough; }
};

/// Takes the collection as one rigid body on its contacts with the frame. Asked every few steps, of
/// what is high and left in motion by the last sweep; else the speed is 0. Deviation: sweeps take
/// the moment of a high tower down to its foot over thousands of steps, a little between any two
/// bricks, and would hold it long after it had to fall. Whether it stands is a question of a few
/// contacts, and of one body. Guarded by Footing.ATowerFallsWhenItsGroundTiltsTooFar.
Footing footingOf(const State& state, Scratch& scratch, const Collection& collection);

}  // namespace merge2d
