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

double approach(const State& state, const Scratch& scratch, RigidId a, RigidId b) {
  const StartMotion of_a = startMotion(state, scratch, a), of_b = startMotion(state, scratch, b);
  const auto turning = [&](RigidId id, double omega) {
    return std::abs(omega) * radius(state.extent(id).bounds, state[id].center);
  };
  return state.h * ((of_b.v - of_a.v).norm() + turning(a, of_a.omega) + turning(b, of_b.omega));
}

double approach(const State& state, const Scratch& scratch, BodyId a, BodyId b) {
  const auto motion = [&](BodyId body) {
    const Rigid& r = state.rigid(body);
    StartMotion at_body = startMotion(state, scratch, state[body].rigid);
    if (state.isCollection(state[body].rigid)) {
      at_body.v += cross(at_body.omega, state.pose(body).position - r.x);
    }
    return at_body;
  };
  const auto turning = [&](BodyId body, double omega) {
    return std::abs(omega) * radius(state.extent(rigidOf(body)).bounds, Vec2::Zero());
  };
  const StartMotion of_a = motion(a), of_b = motion(b);
  return state.h * ((of_b.v - of_a.v).norm() + turning(a, of_a.omega) + turning(b, of_b.omega));
}

namespace {

/// The speed of the fastest point of all that is awake, at most, where `motion(id)` is how a rigid
/// thing moves [m/s].
template <class MotionOf>
double fastestPoint(const State& state, MotionOf&& motion) {
  double fastest = 0.0;
  for (const RigidId id : state.present) {
    const Rigid& r = state[id];
    if (r.asleep) continue;
    const StartMotion of = motion(id);
    const double turning = std::abs(of.omega) * radius(state.extent(r).bounds, r.center);
    fastest = std::max(fastest, of.v.norm() + turning);
  }
  return fastest;
}

}  // namespace

double farthestApproach(const State& state, const Scratch& scratch) {
  const auto at_start = [&](RigidId id) { return startMotion(state, scratch, id); };
  return 2.0 * state.h * fastestPoint(state, at_start);
}

double farthestMove(const State& state, const Scratch& scratch) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  if (state.settings.solver.stabilisation == Stabilisation::Post) return kUnknown;
  const auto now = [&](RigidId id) { return StartMotion{state[id].v, state[id].omega}; };
  double farthest = state.h * fastestPoint(state, now);
  for (const HitWay& hit : scratch.hit_ways) {
    const Rigid& r = state[hit.id];
    const double turning = std::abs(hit.turn) * radius(state.extent(r).bounds, r.center);
    farthest = std::max(farthest, hit.way.norm() + turning);
  }
  return farthest;
}

}  // namespace merge2d
