#include "src2d/merging/open_solve.h"

#include <algorithm>

#include "src2d/dynamics/solver.h"
#include "src2d/merging/momentum.h"
#include "src2d/merging/open_region.h"
#include "src2d/merging/proof_search.h"
#include "src2d/merging/sweep.h"

namespace merge2d {
namespace {

/// A member begins with the velocity that it had before its collection turned in the last step: to
/// turn it takes forces.
void startMember(State& state, const Rigid& whole, BodyId b) {
  const Vec2 arm = whole.previous_rotation * (state[b].local - whole.center);
  Rigid& r = state[rigidOf(b)];
  r.x = state.pose(b).position;
  r.rest = Vec2::Zero();
  r.v = whole.v + cross(whole.omega, arm);
  r.omega = whole.omega;
}

/// Notes the members of the collections that are open, and the regions that the solve begins with.
std::vector<OpenRegion> open(State& state, Scratch& scratch) {
  std::vector<OpenRegion> regions;
  scratch.opened.clear();
  scratch.open_start.resize(state.bodies.size());
  for (Collection& c : state.collections) {
    if (doubtAbout(state, scratch, c) != Doubt::Open) continue;
    readImpulses(c, c.certificate.front().search.load);
    for (const BodyId b : c.members) {
      startMember(state, state[c.rigid], b);
      const Rigid& r = state[rigidOf(b)];
      scratch.open_start[index(b)] = {r.v.x(), r.v.y(), r.omega};
      scratch.opened.push_back(b);
    }
    regions.emplace_back(state, scratch, c);
  }
  return regions;
}

void listRegions(State& state, Scratch& scratch, const std::vector<OpenRegion>& regions) {
  scratch.open.assign(state.bodies.size(), 0);
  scratch.open_members.clear();
  scratch.open_rows.clear();
  for (const OpenRegion& region : regions) region.list(state, scratch);
  std::ranges::sort(scratch.open_members);
}

/// Each body's own velocity after the solve; the world's stands last.
void showVelocities(const State& state, Scratch& scratch) {
  scratch.sweep_u.resize(state.bodies.size() + 1);
  scratch.sweep_u.back() = {};
  for (std::uint32_t i = 0; i < state.bodies.size(); ++i) {
    if (state.bodies[i].alive) scratch.sweep_u[i] = solvedVelocity(state, scratch, BodyId{i});
  }
}

void takeJointImpulses(const State& state, Collection& c) {
  for (JointBlock& k : c.joints) k.lambda = state.joints[k.joint].lambda;
}

}  // namespace

Doubt doubtAbout(const State& state, const Scratch& scratch, const Collection& c) {
  const auto slot = state.collections.slotOf(c);
  return slot < scratch.doubts.size() && isSwept(state, c) ? scratch.doubts[slot] : Doubt::None;
}

void solveOpened(State& state, Scratch& scratch) {
  std::vector<OpenRegion> regions = open(state, scratch);
  scratch.last_sweep = state.step;
  for (bool wider = true; wider;) {
    listRegions(state, scratch, regions);
    scratch.solved = false;
    solveContacts(state, scratch);
    wider = false;
    for (OpenRegion& region : regions) wider |= region.widen(state, scratch);
  }
  scratch.solved = true;
  showVelocities(state, scratch);
  for (Collection& c : state.collections) {
    if (doubtAbout(state, scratch, c) != Doubt::Open) continue;
    takeJointImpulses(state, c);
    relaxOpen(state, scratch, c);
  }
}

namespace {

/// The gain of a body's velocity in the step.
SolverVelocity gainOf(const Scratch& scratch, BodyId b) {
  SolverVelocity gain = scratch.sweep_u[index(b)];
  const Twist& before = scratch.open_start[index(b)];
  gain.vx -= before.vx;
  gain.vy -= before.vy;
  gain.omega -= before.omega;
  return gain;
}

void closeCollection(const State& state, Scratch& scratch, const Collection& c) {
  const Rigid& r = state[c.rigid];
  SolverVelocity& u = scratch.u[index(c.rigid)];
  u = {};
  if (r.floating()) {
    const VelocityField gain =
        momentumField(state, c, [&](BodyId b) { return gainOf(scratch, b); });
    u = {r.v.x() + gain.v.x(), r.v.y() + gain.v.y(), r.omega + gain.omega};
  } else if (r.anchor != kWorldFrame) {
    const Rigid& anchor = state[rigidOf(c.anchor)];
    u = {anchor.v.x(), anchor.v.y(), anchor.omega};
  }
}

}  // namespace

void closeOpened(State& state, Scratch& scratch) {
  if (scratch.opened.empty()) return;
  scratch.u.resize(state.rigids.size() + 1);
  scratch.u.back() = {};
  for (const BodyId b : scratch.opened) {
    const RigidId id = state[b].rigid;
    if (id == rigidOf(b)) {
      const Rigid& r = state[id];
      const SolverVelocity gain = gainOf(scratch, b);
      scratch.u[index(b)] = {r.v.x() + gain.vx, r.v.y() + gain.vy, r.omega + gain.omega};
    } else if (state.collection(id).members.front() == b) {
      closeCollection(state, scratch, state.collection(id));
    }
  }
  scratch.opened.clear();
  scratch.open_members.clear();
  scratch.open.clear();
}

}  // namespace merge2d
