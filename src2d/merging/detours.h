#pragma once
/// Ways around a weld: what is cut does not part its two bodies while other welds hold them.

#include <cstdint>
#include <span>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Numbers the nodes of the graph of welds, a member by its place and the frame last, and lists the
/// welds of each node.
void indexWelds(const State& state, Collection& c);

/// True when welds near each of these, what is left of it included and none of them cut, hold its
/// two bodies in one rigid group, and not by way of the frame. What held together with these welds
/// then holds together without them. False when in doubt.
bool heldByDetours(const State& state, const Collection& c, std::span<const std::uint32_t> welds);

}  // namespace merge2d
