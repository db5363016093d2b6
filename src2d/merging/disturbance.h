#pragma once
/// ContactOrdering: where something new enters in this step (Section 6.2).

#include "src2d/dynamics/state.h"

namespace merge2d {

/// ContactOrdering: the bodies at which something is new: a fresh contact that closes in this step,
/// or an impulse.
void orderContacts(State& state, Scratch& scratch);

}  // namespace merge2d
