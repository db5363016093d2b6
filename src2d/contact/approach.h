#pragma once
/// How far two things can come towards each other in this step: contacts are looked for that far
/// ahead, so that nothing passes through anything.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Velocity at the start of a step, with the impulses that the step is about to give.
struct StartMotion {
  Vec2 v = Vec2::Zero();  ///< of the centre of mass [m/s]
  double omega = 0.0;     ///< [rad/s]
};
/// The kicks must have been ordered.
StartMotion startMotion(const State& state, const Scratch& scratch, RigidId id);

/// The same with gravity and forces: the motion through this step if nothing touches the body. The
/// loads must have been ordered too.
StartMotion freeMotion(const State& state, const Scratch& scratch, RigidId id);

/// List the kicks and loads of the step by the rigid things that they act on now, so that the
/// motion of one does not cost a look at all of them.
void orderKicks(const State& state, Scratch& scratch);
void orderLoads(const State& state, Scratch& scratch);

/// An upper bound of the way [m] that a point of the first can go against one of the second in this
/// step, but for what contacts and forces add.
double approach(const State& state, const Scratch& scratch, RigidId a, RigidId b);

/// The same for any two things.
double farthestApproach(const State& state, const Scratch& scratch);

/// The same for two bodies, wherever their rigid things have their centres.
double approach(const State& state, const Scratch& scratch, BodyId a, BodyId b);

/// How far the velocities of now carry any point in a step, at most: what advancePositions moves
/// anything, unless it corrects positions too [m].
double farthestMove(const State& state, const Scratch& scratch);

}  // namespace merge2d
