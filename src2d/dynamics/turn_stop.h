#pragma once
/// Bodies that turn far in a step, past what the rows of their contacts can tell.
///
/// A row bounds the motion of one point along one normal, to first order. A box that meets a plate
/// with a corner at 100 m/s turns by radians in the rest of the step, and another corner, which was
/// behind, comes round through the plate. So the way of such a body is followed against what it
/// touches, in steps in which nothing passes through anything, and ends before an overlap that was
/// not there; for the rest of the step it goes along with a scripted body that it met, which
/// nothing holds up. Its velocity stays: the next step begins with the contact at which it was
/// stopped.
///
/// The same holds for a body that a blow has given a long way in the step: contacts were looked for
/// along the way that it had at the start.

#include <vector>

#include "src2d/dynamics/scratch.h"
#include "src2d/dynamics/state.h"

namespace merge2d {

/// A body that goes only a part of its way through the step.
struct StoppedTurn {
  RigidId id{};
  double part = 1.0;          ///< of the step
  Vec2 along = Vec2::Zero();  ///< the way on which it is taken along after that [m]
};

/// Lists the bodies to stop, before anything is moved. Bodies in joints or collections are not:
/// the others that hold to them would go on.
void findStoppedTurns(const State& state, const Scratch& scratch,
                      std::vector<StoppedTurn>& stopped);

}  // namespace merge2d
