#pragma once
/// The part of an open collection that a hit reaches. Its members take part in the full solve on
/// their own. The rest stays one body that moves with its frame; the contacts between the two push
/// with the impulses that they hold. After a solve the region is widened beyond each of them that
/// has a residual, and by each member that something outside pushes anew, unless contacts can pass
/// that on to the frame (region_loads.h): no momentum ends at its border.

#include <span>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The velocity of a body in the full solve.
SolverVelocity solvedVelocity(const State& state, const Scratch& scratch, BodyId b);

/// The region that a solve begins with: the members that an impulse of the user moves, and those
/// that the impulses inside do not keep at rest; all of them where the collection floats or was
/// opened by a search. The loads from outside must be listed.
void beginRegion(State& state, Scratch& scratch, Collection& c, OpenRegion& region);

/// Adds the members and rows of the region to those of the full solve.
void listRegion(State& state, Scratch& scratch, OpenRegion& region);

/// After the solve: true where a contact at the border had a residual, or something outside pushes
/// a member by more than contacts carry, and the region is wider now. The loads from outside must
/// be listed again.
bool widen(State& state, Scratch& scratch, OpenRegion& region);

/// The welds and the blocks at some members, ascending.
std::vector<std::uint32_t> weldsAt(const Collection& c, std::span<const std::uint32_t> members);
std::vector<std::uint32_t> blocksAt(const Collection& c, std::span<const std::uint32_t> members);

/// Puts the impulses back that the blocks had before the solve: those of a whole region stand in
/// the load that was sought.
void restoreImpulses(const State& state, Collection& c, const OpenRegion& region, Witness& sought);

}  // namespace merge2d
