#pragma once
/// Which members of a collection a load may move, so that they must be on their own in an open
/// region.

#include <vector>

#include "src2d/dynamics/state.h"
#include "src2d/relaxation/imbalance.h"

namespace merge2d {

/// The imbalance of a member where it is too slow for a hit to see, or else none.
Twist slowPartOf(const State& state, const Collection& c, const Imbalance& imbalance,
                 std::uint32_t member);

/// Before the solve: the members that the impulses inside do not keep at rest. In a hit those of
/// which contacts can pass the rest of the load on to the frame (load_path.h) stay, and those on
/// which something outside acts wait for the solve, which tells how much. The loads from outside
/// must be listed.
void addUnbalanced(State& state, Scratch& scratch, Collection& c, OpenRegion& region);

/// After the solve: the members outside the region that something outside the collection pushes by
/// more than the impulses inside and, where the hit `passes`, contacts on the way to the frame can
/// carry. The loads from outside must be listed again.
std::vector<std::uint32_t> findDisturbed(const State& state, const Scratch& scratch, Collection& c,
                                         bool passes);

}  // namespace merge2d
