#include "src2d/dynamics/integrate.h"

#include "src2d/contact/approach.h"
#include "src2d/dynamics/stabilise.h"

namespace merge2d {

void advanceVelocities(State& state, Scratch& scratch) {
  for (const RigidId id : state.present) {
    Rigid& r = state[id];
    const bool anchored = !r.floating() && state.isCollection(id);  // takes its frame's velocity
    if (r.asleep || !(r.floating() || anchored)) continue;
    SolverVelocity& u = scratch.u[index(id)];
    u.gained = {static_cast<float>(u.vx - r.v.x()), static_cast<float>(u.vy - r.v.y()),
                static_cast<float>(u.omega - r.omega)};
    r.v = {u.vx, u.vy};
    r.omega = u.omega;
  }
}

namespace {

/// Bodies that were hit went another way than their velocity after the step tells.
void followHits(State& state, const Scratch& scratch) {
  for (const HitWay& hit : scratch.hit_ways) {
    Rigid& r = state[hit.id];
    if (!r.present()) continue;  // a member of a collection that was open
    r.moveBy(hit.way - state.h * r.v);
    r.angle += hit.turn - state.h * r.omega;
    r.rotation = Rotation::of(r.angle);
  }
}

/// Brings anchored collections to their frame's pose and velocity.
void followAnchors(State& state) {
  for (const Collection& c : state.collections) {
    if (c.id == kNoCollection) continue;
    Rigid& r = state[c.rigid];
    if (r.floating() || r.anchor == kWorldFrame) continue;
    const Rigid& anchor = state[rigidOf(c.anchor)];
    r.x = anchor.x;
    r.rest = anchor.rest;
    r.angle = anchor.angle;
    r.rotation = anchor.rotation;
    r.previous_rotation = anchor.previous_rotation;
    r.v = anchor.v;
    r.omega = anchor.omega;
  }
}

}  // namespace

void advancePositions(State& state, Scratch& scratch) {
  state.moved = farthestMove(state, scratch);
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
  followHits(state, scratch);
  correctPositions(state, scratch);
  followAnchors(state);
}

}  // namespace merge2d
