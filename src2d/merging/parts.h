#pragma once
/// The parts of a collection that its welds still hold together without those that are cut.

#include <cstdint>
#include <vector>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Node 0 is the frame; it holds bodies in place but does not join them into one collection.
struct Parts {
  std::vector<std::uint32_t> part;     ///< per member
  std::vector<std::uint8_t> anchored;  ///< per part
};

/// The parts that the remaining welds hold together under the cycle criterion.
Parts partsWithoutCuts(const State& state, const Collection& c);

/// The connected components of the remaining welds that have an active contact or a joint.
Parts connectedParts(const State& state, const Collection& c);

bool fallsApart(const State& state, const Collection& c, const Parts& parts);

}  // namespace merge2d
