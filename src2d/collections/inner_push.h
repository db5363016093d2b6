#pragma once
/// The velocities that the impulses inside a collection give its members: where a sweep begins, so
/// that no pass over the rows is needed for a warm start.

#include <span>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Computes the push of each member, unless it is known.
void layOutPush(const State& state, Collection& collection);

/// Computes it anew for members at which impulses have changed, ascending. They may be unbalanced
/// from then on. The welds must be listed by member; joints inside there are none.
void renewPush(const State& state, Collection& collection, std::span<const std::uint32_t> members);

/// The collection has grown by blocks from this one on, and by members: adds their push. Which
/// members are unbalanced is not known afterwards.
void extendPush(const State& state, Collection& collection, std::uint32_t first);

}  // namespace merge2d
