#include "src2d/dynamics/free_motion.h"

#include <algorithm>

namespace merge2d {
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

}  // namespace merge2d
