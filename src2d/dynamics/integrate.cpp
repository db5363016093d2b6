#include "src2d/dynamics/integrate.h"

#include <fmt/format.h>

#include "src2d/contact/approach.h"
#include "src2d/core/error.h"
#include "src2d/dynamics/stabilise.h"
#include "src2d/merging/collection.h"

namespace merge2d {

void advanceVelocities(State& state, const Scratch& scratch) {
  for (std::size_t i = 0; i < state.rigids.size(); ++i) {
    Rigid& r = state.rigids[i];
    const bool anchored = !r.floating() && i >= state.bodies.size();  // takes its frame's velocity
    if (!r.present() || r.asleep || !(r.floating() || anchored)) continue;
    r.v = {scratch.u[i].vx, scratch.u[i].vy};
    r.omega = scratch.u[i].omega;
  }
}

void advancePositions(State& state, Scratch& scratch) {
  state.moved = farthestMove(state);
  for (std::size_t i = 0; i < state.rigids.size(); ++i) {
    Rigid& r = state.rigids[i];
    if (!r.present() || r.asleep || r.anchor == kWorldFrame) continue;
    r.previous_rotation = r.rotation;
    if (!r.floating() && i >= state.bodies.size()) continue;  // anchored: follows its frame
    r.moveBy(state.h * r.v);
    if (r.omega == 0.0) continue;
    r.angle += state.h * r.omega;
    r.rotation = Rotation::of(r.angle);
  }
  correctPositions(state, scratch);
  followAnchors(state);
}

void checkFinite(const State& state, const std::vector<BodyInfo>& bodies, Stage stage) {
  for (std::size_t i = 0; i < state.rigids.size(); ++i) {
    const Rigid& r = state.rigids[i];
    if (!r.present()) continue;
    const double sum = r.x.sum() + r.v.sum() + r.angle + r.omega;
    if (std::isfinite(sum)) continue;
    const BodyId body = i < state.bodies.size()
                            ? BodyId{static_cast<std::uint32_t>(i)}
                            : state.collections[i - state.bodies.size()].members.front();
    throw SimulationError(
        fmt::format("body '{}' is no longer at a finite place after {} in step {} "
                    "(x = {}, {}; v = {}, {}; omega = {}); try a smaller step or softer springs",
                    bodies[index(body)].name, name(stage), state.step + 1, r.x.x(), r.x.y(),
                    r.v.x(), r.v.y(), r.omega));
  }
}

}  // namespace merge2d
