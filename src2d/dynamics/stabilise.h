#pragma once
/// Post-step stabilisation (Cline and Pai 2003): overlaps and open joints are corrected in the
/// positions, after the step, and no velocity comes of it. Baumgarte's feeds the correction into
/// the velocities instead; on a fast circle it then keeps bodies from ever sharing a motion
/// (Section 8.1, the spinner).

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The part of an error that one step removes.
inline constexpr double kCorrectedShare = 0.5;

/// Under `solver.stabilisation = "post"`: moves the things in B by the smallest motions that remove
/// half of each overlap; the rows of this step serve again.
void correctPositions(State& state, Scratch& scratch);

}  // namespace merge2d
