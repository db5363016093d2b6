#pragma once
/// Doubts that pass from one collection or frame to others.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// A hit passes through all collections that touch each other.
void spreadHits(State& state, Scratch& scratch);

/// A blow may reach a collection on a frame through other bodies and joints, and one that floats
/// through joints: the solve of the step tells (reached_collection.h). Where it comes through
/// contacts alone, one that floats takes it as one body, and its own load is asked in the next
/// step.
void noteReached(State& state, Scratch& scratch);

/// A collection on a frame stands like a wall in the solve, also for one that is open and joined to
/// it: the two would bear each other's load in turn. So the solve tells what such a joint puts on
/// it, too. Guarded by JoinedStacks.APullMovesAllBodiesOfARow.
void askJoined(State& state, Scratch& scratch);

/// Between two things that are fixed to different frames the full solve has no row, and no load
/// tells how one drags at the other: where a frame moves, the collections that it drags are opened.
void openWhatFramesDrag(const State& state, Scratch& scratch);

}  // namespace merge2d
