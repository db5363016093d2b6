#include "src2d/dynamics/integrate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src2d/dynamics/hits.h"
#include "src2d/dynamics/stabilise.h"
#include "src2d/dynamics/task_pool.h"
#include "src2d/dynamics/turn_stop.h"

namespace merge2d {

namespace {

constexpr std::size_t kRunOfRigids = 256;  ///< that one task moves

/// A velocity that died away, as 0: sums of subnormal numbers take a hundred times as long.
double withoutSubnormal(double x) {
  return std::abs(x) < std::numeric_limits<double>::min() ? 0.0 : x;
}

}  // namespace

void advanceVelocities(State& state, Scratch& scratch) {
  const auto& present = state.present.ids();
  forEachIndex(scratch.tasks, present.size(), kRunOfRigids, [&](std::size_t i, int) {
    const RigidId id = present[i];
    Rigid& r = state[id];
    const bool anchored = !r.floating() && state.isCollection(id);  // takes its frame's velocity
    if (r.asleep || !(r.floating() || anchored)) return;
    SolverVelocity& u = scratch.u[index(id)];
    u.gained = {static_cast<float>(u.vx - r.v.x()), static_cast<float>(u.vy - r.v.y()),
                static_cast<float>(u.omega - r.omega)};
    r.v = {withoutSubnormal(u.vx), withoutSubnormal(u.vy)};
    r.omega = withoutSubnormal(u.omega);
  });
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

/// Takes back the rest of the way of each body that is stopped, and takes it along instead.
void stopTurns(State& state, const Scratch& scratch, const std::vector<StoppedTurn>& stopped) {
  for (const StoppedTurn& stop : stopped) {
    Rigid& r = state[stop.id];
    const HitWay whole = wayInStep(state, scratch, stop.id);
    const double left = 1.0 - stop.part;
    r.moveBy(stop.along - left * whole.way);
    r.angle -= left * whole.turn;
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

namespace {

/// The speed of the fastest point of all that is awake, at most [m/s].
double fastestPoint(const State& state) {
  double fastest = 0.0;
  for (const RigidId id : state.present) {
    const Rigid& r = state[id];
    if (r.asleep) continue;
    const double turning = std::abs(r.omega) * farthestFrom(state.extent(r).bounds, r.center);
    fastest = std::max(fastest, r.v.norm() + turning);
  }
  return fastest;
}

/// How far the velocities of now carry any point in a step, at most [m]; unknown where positions
/// are corrected too.
double farthestMove(const State& state, const Scratch& scratch) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  if (state.settings.solver.stabilisation == Stabilisation::Post) return kUnknown;
  double farthest = state.h * fastestPoint(state);
  for (const HitWay& hit : scratch.hit_ways) {
    const Rigid& r = state[hit.id];
    const double turning = std::abs(hit.turn) * farthestFrom(state.extent(r).bounds, r.center);
    farthest = std::max(farthest, hit.way.norm() + turning);
  }
  return farthest;
}

}  // namespace

void advancePositions(State& state, Scratch& scratch) {
  std::vector<StoppedTurn> stopped;
  findStoppedTurns(state, scratch, stopped);
  state.moved = farthestMove(state, scratch);
  const auto& present = state.present.ids();
  forEachIndex(scratch.tasks, present.size(), kRunOfRigids, [&](std::size_t i, int) {
    Rigid& r = state[present[i]];
    if (r.asleep || r.anchor == kWorldFrame) return;
    r.previous_rotation = r.rotation;
    if (!r.floating() && state.isCollection(present[i])) return;  // anchored: follows its frame
    r.moveBy(state.h * r.v);
    if (r.omega == 0.0) return;
    r.angle += state.h * r.omega;
    r.rotation = Rotation::of(r.angle);
  });
  followHits(state, scratch);
  stopTurns(state, scratch, stopped);
  correctPositions(state, scratch);
  followAnchors(state);
}

}  // namespace merge2d
