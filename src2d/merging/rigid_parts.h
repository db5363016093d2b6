#pragma once
/// Parts of a collection, each taken as one body, on the contacts between them.

#include <functional>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Whether a weld between two members makes them one part.
using Joins = std::function<bool(const Weld&)>;

/// Takes members as one part that are joined by welds for which `joins` is true, and gives each
/// part the momentum that the sweep has left its members. What else they touch is immovable: the
/// frame, and bodies outside, which move as the sweep has left them, or their collection. False
/// when there are too many parts or contacts to be solved in passing.
bool formParts(const State& state, Scratch& scratch, const Collection& collection,
               const Joins& joins);

/// Solves the contacts between the parts until none moves faster than `enough` against another that
/// it is welded to, or their motion does not change any more. Returns the largest such speed [m/s];
/// 0 where the sweeps cannot tell.
double settleParts(const State& state, Scratch& scratch, const Collection& collection,
                   double enough);

/// The welds, ascending, whose parts move faster against each other than `speed` [m/s].
std::vector<std::uint32_t> weldsFasterThan(const State& state, const Scratch& scratch,
                                           const Collection& collection, double speed);

}  // namespace merge2d
