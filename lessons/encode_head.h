#pragma once
/// The JSON head of an encoded trace: what the run was, and what its packed columns mean.

#include <cstdint>
#include <string>
#include <vector>

#include "lessons/pack.h"
#include "lessons/recording.h"

namespace merge2d {

/// The head of a recording, which tells how to read its columns.
struct ColumnLegend {
  std::int64_t every = 1;  ///< time steps between two samples of contacts and decisions
  Linear length, angle;
  Logarithmic amount;                          ///< of velocities and impulses
  std::vector<const DecisionTrack*> criteria;  ///< the first track of each criterion
  std::vector<const ImpulsesInside*> inside;   ///< in the order of steps
};

/// A JSON object; lessons/web/src/head.ts is its type.
std::string headOf(const Recording& recording, const ColumnLegend& legend);

}  // namespace merge2d
