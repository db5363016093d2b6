#pragma once
/// Doubted collections in the full solve. They are opened: each member moves on its own there, and
/// the contacts inside have rigid rows beside those of all other contacts. Unmerge cuts the welds
/// whose bodies then move against each other (decided_unmerge.h); the parts move on as one body
/// each, with the momentum of their members.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The doubt about a collection that was there when the step began.
Doubt doubtAbout(const State& state, const Scratch& scratch, const Collection& collection);

/// The full solve of this step, with the collections open about which there is a doubt. The
/// velocities of open members and of their neighbours, those marked in `scratch.swept`, are then in
/// `scratch.sweep_u`, and Collection::residual is the largest change that one more solve of a row
/// inside would make [m/s].
void solveOpened(State& state, Scratch& scratch);

/// Before a collection is taken apart: the velocities of its members that were not open, too.
void showRest(const State& state, Scratch& scratch, const Collection& c);

/// Gives the collections that were open, and the parts into which they have been split, the
/// momentum of their members, for AdvanceVelocities.
void closeOpened(State& state, Scratch& scratch);

}  // namespace merge2d
