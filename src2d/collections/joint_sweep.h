#pragma once
/// The joints in the single sweep: those inside collections, with rigid rows in the collection's
/// frame, and those around them.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Rows of the joints that act inside the collection.
void layOutJoints(const State& state, Collection& collection);

/// Adds their impulses to the pushes of the members by `add(body, sign, impulse, moment)`.
template <class Add>
void addJointPush(const Collection& collection, Add&& add) {
  for (const JointBlock& k : collection.joints) {
    k.forEachRow([&](std::size_t i) {
      const JointRow& r = k.rows[i];
      const Vec2 impulse = k.lambda[i] * Vec2(r.dx, r.dy);
      add(k.a, -1.0, impulse, r.arm_a * k.lambda[i]);
      add(k.b, 1.0, impulse, r.arm_b * k.lambda[i]);
    });
  }
}

/// Gives rows to the joints at swept collections and marks their bodies in `near_collection`.
void listSweepJoints(const State& state, Scratch& scratch);

/// Puts last step's impulses of these joints, and of others at marked bodies, on the velocities.
void warmStartSweepJoints(const State& state, Scratch& scratch);

/// Keeps the impulses of the sweep where the full solve has no row: inside collections and between
/// fixed things.
void keepJointForces(State& state, Scratch& scratch);

}  // namespace merge2d
