#include "src2d/merging/weld_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src2d/relaxation/proof_search.h"

namespace merge2d {

WeldMotion WeldMotions::of(const Weld& weld, double ignored) const {
  const Vec2 origin = state_[isMember(weld.a) ? weld.a : weld.b].local;
  const VelocityField a = field(weld.a, origin), b = field(weld.b, origin);
  const double linear = (b.v - a.at(b.x)).norm(), turning = std::abs(b.omega - a.omega);
  if (linear + turning * reachFrom(origin + b.x, weld) <= ignored) return {};
  WeldMotion motion{0.0, std::numeric_limits<double>::infinity()};
  for (const BodyId id : {weld.a, weld.b}) {
    if (!isMember(id)) continue;
    const double speed = fastestCorner(boxOf(id, origin), a, b);
    motion = {std::max(motion.most, speed), std::min(motion.least, speed)};
  }
  return motion;
}

bool WeldMotions::turns(const Weld& weld, double noise) const {
  const double limit = limitOf(weld);
  const WeldMotion motion = of(weld, limit);
  return !weld.expected && motion.most > limit && motion.least > noise;
}

/// Seen from an origin near by, so that the rounding does not depend on where the frame's is. The
/// bodies of the frame are at rest.
VelocityField WeldMotions::field(BodyId b, const Vec2& origin) const {
  if (!isMember(b)) return {};
  const SolverVelocity& u = u_[index(b)];
  return {state_[b].local - origin, {u.vx, u.vy}, u.omega};
}

/// The box of a member.
OrientedBox WeldMotions::boxOf(BodyId b, const Vec2& origin) const {
  OrientedBox box = state_.extent(rigidOf(b)).box;
  box.frame = Pose{state_[b].local - origin, state_[b].local_rotation} * box.frame;
  return box;
}

/// No corner of a member is farther away than this [m].
double WeldMotions::reachFrom(const Vec2& x, const Weld& weld) const {
  double reach = 0.0;
  for (const BodyId id : {weld.a, weld.b}) {
    if (!isMember(id)) continue;
    const OrientedBox& box = state_.extent(rigidOf(id)).box;
    const double radius = box.frame.position.norm() + box.half.norm();
    reach = std::max(reach, (state_[id].local - x).norm() + radius);
  }
  return reach;
}

double fastestOf(const State& state, const SweepMemory& memory, const Collection& c) {
  const WeldMotions motions(state, c, memory.trial_u);
  double most = fastestContact(memory, c);
  for (const Weld& weld : c.welds) {
    if (weld.expected) continue;
    const WeldMotion motion = motions.of(weld, 0.0);
    if (motion.least > toleratedResidual(state)) most = std::max(most, motion.most);
  }
  return most;
}

std::vector<std::uint8_t> moversOf(const State& state, const SweepMemory& memory,
                                   const Collection& c) {
  const WeldMotions motions(state, c, memory.trial_u);
  std::vector<std::uint8_t> movers;
  movers.reserve(c.welds.size());
  for (const Weld& weld : c.welds) {
    const double limit = motions.limitOf(weld);
    movers.push_back(motions.of(weld, limit).most > limit ? 1 : 0);
  }
  return movers;
}

}  // namespace merge2d
