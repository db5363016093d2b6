#pragma once
/// Runs of so many steps and bodies that not every step can be kept in full.

#include "lessons/recording.h"

namespace merge2d {

/// Runs the scene of `out` for `steps` steps. The motion is kept in keyframes; contacts, decisions,
/// the ledger and the impulses inside steps are kept every `out.every` steps. Throws
/// SimulationError.
void recordInKeyframes(Recording& out, std::int64_t steps,
                       const std::function<void(std::int64_t)>& progress);

}  // namespace merge2d
