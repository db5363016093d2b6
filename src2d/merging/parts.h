#pragma once
/// The parts of a collection that its welds still hold together without those that are cut.

#include <cstdint>
#include <vector>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The frame holds bodies in place but does not join them into one collection.
struct Parts {
  std::vector<std::uint32_t> part;     ///< per member
  std::vector<std::uint8_t> anchored;  ///< per part
};

/// Contacts of a weld that have carried a force and have not opened since, and the contacts that
/// its joints count as.
int activeContacts(const Collection& c, const Weld& weld);

/// The components of the graph of welds that are not cut: in a converged solution each body that
/// does not move is held, and no rigidity need be asked for.
Parts componentsOf(const Collection& c);

/// The connected components of the remaining welds that have an active contact or a joint.
Parts connectedParts(const State& state, const Collection& c);

bool fallsApart(const State& state, const Collection& c, const Parts& parts);

}  // namespace merge2d
