#pragma once
/// Parts of a collection, each taken as one body, on the contacts between them.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Makes a part of each set of `scratch.rigid_parts`; see formParts.
bool makeParts(const State& state, Scratch& scratch, const Collection& collection);

/// Takes members as one part that are joined by welds for which `joins` is true, and gives each
/// part the momentum that the sweep has left its members. The frame, and bodies that rest against
/// the parts, are immovable; others that the parts touch have the velocity that the sweep has left
/// them, or their collection, and its mass. False when there are too many parts or contacts to be
/// solved in passing.
template <class Joins>
bool formParts(const State& state, Scratch& scratch, const Collection& collection, Joins&& joins) {
  const auto members = static_cast<std::uint32_t>(collection.members.size());
  DisjointSets& sets = scratch.sets;
  sets.reset(members);
  for (const Weld& weld : collection.welds) {
    const bool inside = weld.node_a < members && weld.node_b < members;
    if (inside && joins(weld)) sets.unite(weld.node_a, weld.node_b);
  }
  return makeParts(state, scratch, collection);
}

/// Solves the contacts between the parts until none moves faster than `enough` against another that
/// it is welded to, or their motion does not change any more. Returns the largest such speed [m/s];
/// 0 where the sweeps cannot tell.
double settleParts(const State& state, Scratch& scratch, const Collection& collection,
                   double enough);

/// The welds, ascending, whose parts move faster against each other than `speed` [m/s].
std::vector<std::uint32_t> weldsFasterThan(const State& state, const Scratch& scratch,
                                           const Collection& collection, double speed);

}  // namespace merge2d
