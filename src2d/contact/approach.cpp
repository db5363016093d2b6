#include "src2d/contact/approach.h"

#include <algorithm>
#include <limits>

namespace merge2d {
namespace {

/// Distance of the farthest point of a box from `center`, at most.
double radius(const Aabb& bounds, const Vec2& center) {
  return (bounds.lower - center).cwiseAbs().cwiseMax((bounds.upper - center).cwiseAbs()).norm();
}

}  // namespace

namespace {

/// Lists each action of `actions` by the rigid thing that its body moves with.
void orderActions(const State& state, const auto& actions, std::vector<ActionOrder>& order) {
  order.clear();
  for (std::uint32_t i = 0; i < actions.size(); ++i) {
    order.push_back({state[actions[i].body].rigid, i});
  }
  std::ranges::sort(order);
}

/// Calls `visit(action)` for those that act on `id`, in their own order.
template <class Action, class Visit>
void forEachOn(RigidId id, const std::vector<ActionOrder>& order,
               const std::vector<Action>& actions, Visit&& visit) {
  if (order.empty()) return;
  auto at = std::ranges::lower_bound(order, id, {}, &ActionOrder::rigid);
  for (; at != order.end() && at->rigid == id; ++at) visit(actions[at->action]);
}

}  // namespace

void orderKicks(const State& state, Scratch& scratch) {
  orderActions(state, scratch.kicks, scratch.kick_order);
}

void orderLoads(const State& state, Scratch& scratch) {
  orderActions(state, scratch.loads, scratch.load_order);
}

StartMotion startMotion(const State& state, const Scratch& scratch, RigidId id) {
  const Rigid& r = state[id];
  StartMotion motion{r.v, r.omega};
  forEachOn(id, scratch.kick_order, scratch.kicks, [&](const Kick& kick) {
    motion.v += r.inv_mass * kick.impulse;
    motion.omega += r.inv_inertia * cross(kick.at - r.x, kick.impulse);
  });
  return motion;
}

StartMotion freeMotion(const State& state, const Scratch& scratch, RigidId id) {
  const Rigid& r = state[id];
  if (state.isCollection(id) && !r.floating() && r.anchor != kWorldFrame) {
    const Rigid& frame = state[rigidOf(state.collection(id).anchor)];
    return {frame.velocityAt(r.x), frame.omega};
  }
  StartMotion motion = startMotion(state, scratch, id);
  if (!r.floating()) return motion;
  motion.v += state.h * state.gravity;
  forEachOn(id, scratch.load_order, scratch.loads, [&](const Load& load) {
    const Vec2 arm = state.pose(load.body).position - r.x;
    motion.v += state.h * r.inv_mass * load.force;
    motion.omega += state.h * r.inv_inertia * (load.torque + cross(arm, load.force));
  });
  return motion;
}

std::vector<Approaches::Motion>& Approaches::memory() {
  thread_local std::vector<Motion> motions;
  return motions;
}

Approaches::Approaches(const State& state, const Scratch& scratch)
    : state_(state), motions_(memory()) {
  motions_.resize(std::max(motions_.size(), state.rigids.size()));
  double fastest = 0.0;
  for (const RigidId id : state.present) {
    const Rigid& r = state[id];
    const StartMotion start = startMotion(state, scratch, id);
    Motion& motion = motions_[index(id)];
    motion = {start.v, start.omega, 0.0};
    if (start.omega != 0.0) {
      motion.turning = std::abs(start.omega) * radius(state.extent(r).bounds, r.center);
    }
    if (!r.asleep) fastest = std::max(fastest, start.v.norm() + motion.turning);
  }
  farthest_ = 2.0 * state.h * fastest;
}

/// Things that are parked are in no list, and stand still.
Approaches::Motion Approaches::of(RigidId id) const {
  return state_.parked.count > 0 && state_.parked.holds(id) ? Motion{} : motions_[index(id)];
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
      std::abs(motion.omega) * radius(state_.extent(rigidOf(body)).bounds, Vec2::Zero());
  return motion;
}

namespace {

/// The speed of the fastest point of all that is awake, at most [m/s].
double fastestPoint(const State& state) {
  double fastest = 0.0;
  for (const RigidId id : state.present) {
    const Rigid& r = state[id];
    if (r.asleep) continue;
    const double turning = std::abs(r.omega) * radius(state.extent(r).bounds, r.center);
    fastest = std::max(fastest, r.v.norm() + turning);
  }
  return fastest;
}

}  // namespace

double farthestMove(const State& state, const Scratch& scratch) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  if (state.settings.solver.stabilisation == Stabilisation::Post) return kUnknown;
  double farthest = state.h * fastestPoint(state);
  for (const HitWay& hit : scratch.hit_ways) {
    const Rigid& r = state[hit.id];
    const double turning = std::abs(hit.turn) * radius(state.extent(r).bounds, r.center);
    farthest = std::max(farthest, hit.way.norm() + turning);
  }
  return farthest;
}

}  // namespace merge2d
