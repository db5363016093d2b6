#pragma once
/// The motion of rigid things in this step as long as nothing touches them.

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

}  // namespace merge2d
