#include "src2d/contact/approach.h"

#include <algorithm>

#include "src2d/core/memory.h"

namespace merge2d {

Approaches::Approaches(const State& state, Scratch& scratch)
    : state_(state), present_(state.present.ids()), motions_(scratch.start_motions) {
  motions_.clear();
  reserveTightly(motions_, present_.size());
  double fastest = 0.0;
  for (const RigidId id : present_) {
    const Rigid& r = state[id];
    const StartMotion start = startMotion(state, scratch, id);
    Motion& motion = motions_.emplace_back();
    motion = {start.v, start.omega, 0.0};
    if (start.omega != 0.0) {
      motion.turning = std::abs(start.omega) * farthestFrom(state.extent(r).bounds, r.center);
    }
    if (!r.asleep) fastest = std::max(fastest, start.v.norm() + motion.turning);
  }
  farthest_ = 2.0 * state.h * fastest;
}

/// Where nothing has merged, its number is its place.
std::size_t Approaches::placeOf(RigidId id) const {
  const std::size_t place = index(id);
  if (place < present_.size() && present_[place] == id) return place;
  return static_cast<std::size_t>(std::ranges::lower_bound(present_, id) - present_.begin());
}

/// Things that are parked are in no list, and stand still.
Approaches::Motion Approaches::of(RigidId id) const {
  return state_.parked.count > 0 && state_.parked.holds(id) ? Motion{} : motions_[placeOf(id)];
}

double Approaches::between(RigidId a, RigidId b) const { return between(of(a), of(b)); }

double Approaches::byTurning(RigidId id) const {
  const Motion motion = of(id);
  const double way = state_.h * motion.turning, turn = state_.h * std::abs(motion.omega);
  return turn > 2.0 ? way * 2.0 / turn : way;
}

double Approaches::between(BodyId a, BodyId b) const {
  const RigidId rigid_a = state_[a].rigid, rigid_b = state_[b].rigid;
  const bool alone = !state_.isCollection(rigid_a) && !state_.isCollection(rigid_b);
  return alone ? between(rigid_a, rigid_b) : between(of(a), of(b));
}

/// About its own centre, also in a collection.
Approaches::Motion Approaches::of(BodyId body) const {
  const RigidId id = state_[body].rigid;
  Motion motion = of(id);
  if (!state_.isCollection(id)) return motion;
  motion.v += cross(motion.omega, state_.pose(body).position - state_[id].x);
  motion.turning =
      std::abs(motion.omega) * farthestFrom(state_.extent(rigidOf(body)).bounds, Vec2::Zero());
  return motion;
}

}  // namespace merge2d
