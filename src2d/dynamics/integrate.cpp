#include "src2d/dynamics/integrate.h"

#include <fmt/format.h>

#include "src2d/contact/approach.h"
#include "src2d/core/error.h"
#include "src2d/dynamics/stabilise.h"
#include "src2d/merging/collection.h"

namespace merge2d {

void advanceVelocities(State& state, const Scratch& scratch) {
  for (const RigidId id : state.present) {
    Rigid& r = state[id];
    const bool anchored = !r.floating() && state.isCollection(id);  // takes its frame's velocity
    if (r.asleep || !(r.floating() || anchored)) continue;
    const SolverVelocity& u = scratch.u[index(id)];
    r.v = {u.vx, u.vy};
    r.omega = u.omega;
  }
}

void advancePositions(State& state, Scratch& scratch) {
  state.moved = farthestMove(state);
  for (const RigidId id : state.present) {
    Rigid& r = state[id];
    if (r.asleep || r.anchor == kWorldFrame) continue;
    r.previous_rotation = r.rotation;
    if (!r.floating() && state.isCollection(id)) continue;  // anchored: follows its frame
    r.moveBy(state.h * r.v);
    if (r.omega == 0.0) continue;
    r.angle += state.h * r.omega;
    r.rotation = Rotation::of(r.angle);
  }
  correctPositions(state, scratch);
  followAnchors(state);
}

void checkFinite(const State& state, Stage stage,
                 const std::function<std::string(BodyId)>& nameOf) {
  for (const RigidId id : state.present) {
    const Rigid& r = state[id];
    const double sum = r.x.sum() + r.v.sum() + r.angle + r.omega;
    if (std::isfinite(sum)) continue;
    const BodyId body = state.isCollection(id) ? state.collection(id).members.front()
                                               : BodyId{static_cast<std::uint32_t>(id)};
    throw SimulationError(fmt::format(
        "body '{}' is no longer at a finite place after {} in step {} "
        "(x = {}, {}; v = {}, {}; omega = {}); try a smaller step or softer springs",
        nameOf(body), name(stage), state.step + 1, r.x.x(), r.x.y(), r.v.x(), r.v.y(), r.omega));
  }
}

}  // namespace merge2d
