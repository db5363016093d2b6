#pragma once
/// The factor on the thresholds of a pair whose last welds were cut in vain.

#include <algorithm>
#include <cstdint>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The most cuts in vain that count; fewer count while something new has just come in, as that may
/// move bodies that nothing moved before.
inline constexpr std::int16_t kMostVain = 8, kMostVainWhenJolted = 5;

/// Cuts in vain that count now.
inline int vainCuts(const Collection& c, const Weld& weld) {
  return std::min(weld.vain, c.jolted > 0 ? kMostVainWhenJolted : kMostVain);
}

/// Factor on all that is asked of a weld before it is cut. Deviation: a pair whose last welds were
/// cut in vain, as it got nowhere when it was free, is cut later, or it would merge and part for
/// ever. Rigid contacts may find motion where soft ones hold, and bodies that land on a heap
/// disturb it again and again. Guarded by Pile.NoPairMergesAndPartsOverAndOver,
/// Caution.LastsWhileAPairIsOnlyJostled and Caution.IsLessWhileAJoltStillCounts.
inline double cautionWith(const State& state, const Collection& c, const Weld& weld) {
  constexpr double kSteps = 200.0;  // of a weld, times the factor, before it is as any other
  if (weld.vain == 0) return 1.0;
  const double factor = static_cast<double>(1 << vainCuts(c, weld));
  const auto lived = static_cast<double>(state.step - c.contacts[weld.first].since);
  return lived < kSteps * factor ? factor : 1.0;
}

}  // namespace merge2d
