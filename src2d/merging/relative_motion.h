#pragma once
/// AccumulateRelativeMotion (Sections 5 and 7): the criteria of each pair, asked and counted.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Counts, for each pair in contact, the consecutive steps in which it could merge: relative
/// motion, Eqs. (15)-(17); sliding, Eq. (18); breathing; and for sleep each rigid thing's own
/// motion.
void accumulateRelativeMotion(State& state, Scratch& scratch);

}  // namespace merge2d
