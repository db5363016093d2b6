#pragma once
/// The members of an open region.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Of the nodes of welds the last one is the frame.
inline bool isFrame(const Collection& c, std::uint32_t node) { return node == c.members.size(); }

inline std::uint32_t otherEnd(const Weld& weld, std::uint32_t node) {
  return weld.node_a == node ? weld.node_b : weld.node_a;
}

/// Calls `visit` with each block of a weld.
template <class Visit>
void forEachBlock(const Collection& c, const Weld& weld, Visit&& visit) {
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) visit(c.contacts[i].block);
}

/// The velocity that the impulses inside leave of a load on a member. Their push must be laid out.
Twist leftOver(const Collection& c, std::uint32_t member, const Twist& load);

/// How fast a corner of a member's box may move [m/s].
double cornerSpeed(const State& state, const Collection& c, std::uint32_t member, const Twist& u);

/// The velocity of a member before the step: before its collection turned in the last one, as to
/// turn it takes forces.
Twist startOf(const State& state, const Collection& c, BodyId member);

/// Slower than this no weld of a member parts [m/s].
double slowestCut(const State& state, const Collection& c, std::uint32_t member);

/// Whether a member is on its own in this step; the frame counts as such.
bool isInside(const Scratch& scratch, const Collection& c, std::uint32_t node);

/// One more member, which has moved with its collection so far.
void addMember(State& state, Scratch& scratch, OpenRegion& region, std::uint32_t member);
void addIfOutside(State& state, Scratch& scratch, OpenRegion& region, std::uint32_t member);
/// All members that are outside.
void addOthers(State& state, Scratch& scratch, OpenRegion& region);

/// All members, as a whole region; the load that is sought keeps the impulses before.
void addAll(State& state, Scratch& scratch, OpenRegion& region);

}  // namespace merge2d
