#include "src2d/dynamics/start_velocities.h"

#include "src2d/core/memory.h"
#include "src2d/dynamics/joint_rows.h"

namespace merge2d {
namespace {

bool simulated(const Rigid& r) { return r.present() && !r.asleep && r.floating(); }

/// The scripted body that a collection is welded to: it has this step's velocity already.
const Rigid& anchorOf(const State& state, std::size_t i) {
  return state[rigidOf(state.collections[i - state.bodies.size()].anchor)];
}

/// Gravity on a body or collection that moves freely.
void addGravity(const State& state, const Rigid& r, SolverVelocity& u) {
  if (u.inv_mass == 0.0) return;
  const double share = u.inv_mass == r.inv_mass ? 1.0 : r.mass * u.inv_mass;
  u.vx += share * state.h * state.gravity.x();
  u.vy += share * state.h * state.gravity.y();
}

/// Velocities and masses before forces act; with `falling` those after gravity has.
void takeVelocities(const State& state, Scratch& scratch, bool falling) {
  reserveTightly(scratch.u, state.rigids.size() + 1);
  scratch.u.resize(state.rigids.size() + 1);
  scratch.u.back() = {};
  for (const RigidId id : state.present) {
    const std::size_t i = index(id);
    const bool anchored = state.isCollection(id) && !state.rigids[i].floating() &&
                          state.rigids[i].anchor != kWorldFrame;
    const Rigid& r = anchored ? anchorOf(state, i) : state.rigids[i];
    SolverVelocity& u = scratch.u[i];
    const bool free = simulated(r);
    u = {r.v.x(), r.v.y(), r.omega, free ? r.inv_mass : 0.0, free ? r.inv_inertia : 0.0};
    if (!state.isCollection(id)) u.surface = state.bodies[i].surface_velocity;
    if (falling) addGravity(state, state.rigids[i], u);
  }
}

/// Members of open collections, which have left their rigid things for this solve.
void takeOpenMembers(const State& state, Scratch& scratch) {
  for (const BodyId b : scratch.open_members) {
    const Rigid& r = state[rigidOf(b)];
    const Vec2 v = r.v + state.h * state.gravity;
    scratch.u[index(b)] = memberVelocity(state, b, {v.x(), v.y(), r.omega});
  }
}

/// The forces and impulses of the step.
void addActions(const State& state, Scratch& scratch) {
  for (const Load& load : scratch.loads) {
    const RigidId mover = moverOf(state, scratch, load.body);
    const Rigid& r = state[mover];
    SolverVelocity& u = scratch.u[index(mover)];
    const double torque = load.torque + cross(state.pose(load.body).position - r.x, load.force);
    u.vx += state.h * u.inv_mass * load.force.x();
    u.vy += state.h * u.inv_mass * load.force.y();
    u.omega += state.h * u.inv_inertia * torque;
  }
  for (const Kick& kick : scratch.kicks) {
    const RigidId mover = moverOf(state, scratch, kick.body);
    const Rigid& r = state[mover];
    SolverVelocity& u = scratch.u[index(mover)];
    u.vx += u.inv_mass * kick.impulse.x();
    u.vy += u.inv_mass * kick.impulse.y();
    u.omega += u.inv_inertia * cross(kick.at - r.x, kick.impulse);
  }
}

}  // namespace

void startVelocities(const State& state, Scratch& scratch) {
  const bool linked = !state.joint_lists.present.empty();
  takeVelocities(state, scratch, !linked);
  if (linked) {
    slowTautLinks(state, scratch);
    for (const RigidId id : state.present) addGravity(state, state[id], scratch.u[index(id)]);
  }
  takeOpenMembers(state, scratch);
  addActions(state, scratch);
}

}  // namespace merge2d
