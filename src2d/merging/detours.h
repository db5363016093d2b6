#pragma once
/// Detours around a cut weld: other welds that still hold its two bodies together.

#include <cstdint>
#include <span>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Numbers the nodes of the graph of welds, a member by its place and the frame last, and lists the
/// welds of each node.
void indexWelds(const State& state, Collection& c);

/// True when the two bodies of each of these welds are in one rigid group by its remaining contacts
/// and by welds near it that are not cut, and not by way of the frame. A collection that held
/// together with these welds then does so without them. False when in doubt.
bool heldByDetours(const State& state, const Collection& c, std::span<const std::uint32_t> welds);

}  // namespace merge2d
