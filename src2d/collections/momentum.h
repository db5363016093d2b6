#pragma once
/// How a collection moves as one body.

#include "src2d/dynamics/state.h"
#include "src2d/dynamics/velocity_field.h"

namespace merge2d {

/// A floating collection has the momentum of its members, of which `velocityOf(b)` is the
/// SolverVelocity; an anchored one moves with its frame.
template <class VelocityOf>
VelocityField momentumField(const State& state, const Collection& c, VelocityOf&& velocityOf) {
  const Rigid& r = state[c.rigid];
  if (!r.floating()) return {r.x, r.v, r.omega};
  Vec2 p = Vec2::Zero();
  double l = 0.0;
  for (const BodyId b : c.members) {
    const Body& body = state[b];
    const SolverVelocity u = velocityOf(b);
    const Vec2 v(u.vx, u.vy);
    p += body.mass * v;
    l += body.mass * cross(r.rotation * (body.local - r.center), v) + body.inertia * u.omega;
  }
  return {r.x, p * r.inv_mass, l * r.inv_inertia};
}

/// The same after the sweeps of this step so far.
VelocityField sweptField(const State& state, const Scratch& scratch, const Collection& c);

}  // namespace merge2d
