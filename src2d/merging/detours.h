#pragma once
/// Ways around a weld: what is cut does not part its two bodies while other welds hold them.

#include <cstdint>
#include <span>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// A node of the graph of welds: a member by its number, or the frame, which stands last.
std::uint32_t nodeOf(const State& state, const Collection& c, BodyId body);

/// Lists the welds of each node.
void indexWelds(const State& state, Collection& c);

/// Two contacts that hold in different places, or joints worth as much: two bodies that such a weld
/// joins are rigid, whatever the criterion. Points nearer than `resolution` [m] are one.
bool isFirm(const Collection& c, const Weld& weld, double resolution);

/// Points of this collection nearer than this count as one [m].
double resolutionOf(const State& state, const Collection& c);

/// True when beside each of these welds a short way of firm welds, none of them cut, leads from one
/// of its bodies to the other, and not through the frame. What held together with these welds then
/// holds together without them. False when in doubt.
bool heldByDetours(const State& state, const Collection& c, std::span<const std::uint32_t> welds);

}  // namespace merge2d
