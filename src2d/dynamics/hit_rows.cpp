#include "src2d/dynamics/hit_rows.h"

#include <algorithm>

#include "src2d/dynamics/casts.h"
#include "src2d/dynamics/free_motion.h"

namespace merge2d {

double leastBounce(const State& state, const ContactKey& key) {
  constexpr double kPart = 0.02, kLeast = 1e-6;  // of the size; m/s
  const double size = state.thickness(key.shape_a, key.shape_b);
  const double fall = std::sqrt(2.0 * state.gravity.norm() * kPart * size);
  return std::max(kLeast, std::min(state.settings.solver.restitution_velocity, fall));
}

const Cast* castToHit(const State& state, const Scratch& scratch, const Contact& contact) {
  const Cast* cast = castOf(scratch, contact);
  if (!cast || !cast->hit || isBilateral(state, contact.key.a, contact.key.b)) return nullptr;
  return cast;
}

bool isHit(const State& state, const Contact& contact, const Cast* cast, double gap, double w_start,
           double w_free) {
  const ContactKey& key = contact.key;
  const double way = -state.h * w_free;
  if (isBilateral(state, key.a, key.b) || way - gap <= kEndOfStep * way) return false;
  if (-w_start <= w_start - w_free) return false;  // loads alone bring them together
  return restitutionOf(state, key.a, key.b) == 0.0 ? cast != nullptr
                                                   : -w_free > leastBounce(state, key);
}

SolverVelocity velocityAtStart(const State& state, const Scratch& scratch, std::uint32_t rigid) {
  SolverVelocity v = scratch.u[rigid];
  if (v.inv_mass == 0.0) return v;
  const StartMotion start = startMotion(state, scratch, RigidId{rigid});
  v.vx = start.v.x();
  v.vy = start.v.y();
  v.omega = start.omega;
  return v;
}

}  // namespace merge2d
