#include "src2d/relaxation/open_solve.h"

#include <algorithm>
#include <utility>

#include "src2d/collections/collection.h"
#include "src2d/collections/momentum.h"
#include "src2d/dynamics/joint_rows.h"
#include "src2d/dynamics/solver.h"
#include "src2d/proofs/collection_load.h"
#include "src2d/relaxation/open_region.h"
#include "src2d/relaxation/reached_collection.h"
#include "src2d/relaxation/region_members.h"
#include "src2d/relaxation/relaxation.h"

namespace merge2d {
namespace {

/// The regions that the solve begins with.
void open(State& state, Scratch& scratch) {
  scratch.regions.clear();
  scratch.opened.clear();
  scratch.open.assign(state.bodies.size(), 0);
  scratch.open_start.resize(state.bodies.size());
  for (Collection& c : state.collections) {
    switch (doubtAbout(state, scratch, c)) {
      case Doubt::None:
      case Doubt::Search:
        break;
      case Doubt::Reached:
        beginReached(state, scratch, c, scratch.regions.emplace_back());
        break;
      case Doubt::Open:
        listWeldsOfMembers(c);
        beginRegion(state, scratch, c, scratch.regions.emplace_back());
        scratch.opened.push_back(c.rigid);
    }
  }
}

void listRegions(State& state, Scratch& scratch) {
  scratch.open_members.clear();
  scratch.open_rows.clear();
  for (OpenRegion& region : scratch.regions) listRegion(state, scratch, region);
  std::ranges::sort(scratch.open_members);
}

void showVelocity(const State& state, Scratch& scratch, BodyId b) {
  if (std::exchange(scratch.swept[index(b)], 1) != 0) return;
  scratch.sweep_u[index(b)] = solvedVelocity(state, scratch, b);
}

/// The own velocities of members that are open, and of their neighbours, after the solve; the
/// world's stands last. Where decisions are noted, those of all bodies.
void showVelocities(const State& state, Scratch& scratch) {
  scratch.sweep_u.resize(state.bodies.size() + 1);
  scratch.sweep_u.back() = {};
  scratch.swept.assign(state.bodies.size() + 1, 0);
  scratch.swept.back() = 1;
  for (const OpenRegion& region : scratch.regions) {
    const Collection& c = state.collections[region.slot];
    for (const std::uint32_t m : region.members) {
      showVelocity(state, scratch, c.members[m]);
      for (const std::uint32_t w : c.welds_of[m]) {
        showVelocity(state, scratch, c.welds[w].a);
        showVelocity(state, scratch, c.welds[w].b);
      }
    }
  }
  if (!scratch.notes) return;
  for (std::uint32_t i = 0; i < state.bodies.size(); ++i) {
    const bool hidden = state.bodies[i].alive && scratch.swept[i] == 0;
    if (hidden) scratch.sweep_u[i] = solvedVelocity(state, scratch, BodyId{i});
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
  open(state, scratch);
  const auto isClosed = [&](const OpenRegion& region) {
    return scratch.doubts[region.slot] == Doubt::Reached;
  };
  scratch.last_sweep = state.step;
  for (bool wider = true; wider;) {
    listRegions(state, scratch);
    solveAllRows(state, scratch);
    listOuterLoads(state, scratch);
    wider = false;
    for (OpenRegion& region : scratch.regions) {
      wider |=
          isClosed(region) ? openReached(state, scratch, region) : widen(state, scratch, region);
    }
  }
  std::erase_if(scratch.regions, isClosed);
  breakOverloadedJoints(state, scratch);
  scratch.solved = true;
  showVelocities(state, scratch);
  for (OpenRegion& region : scratch.regions) {
    takeJointImpulses(state, state.collections[region.slot]);
    relaxOpen(state, scratch, region);
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

void showRest(const State& state, Scratch& scratch, const Collection& c) {
  for (const BodyId b : c.members) {
    if (scratch.open[index(b)] != 0) continue;
    showVelocity(state, scratch, b);
    scratch.open_start[index(b)] = startOf(state, c, b);
  }
}

void closeOpened(State& state, Scratch& scratch) {
  if (scratch.opened.empty()) return;
  scratch.u.resize(state.rigids.size() + 1);
  scratch.u.back() = {};
  for (const RigidId id : scratch.opened) {
    if (!state.isCollection(id)) {
      const Rigid& r = state[id];
      const SolverVelocity gain = gainOf(scratch, BodyId{static_cast<std::uint32_t>(id)});
      scratch.u[index(id)] = {r.v.x() + gain.vx, r.v.y() + gain.vy, r.omega + gain.omega};
    } else if (state.collection(id).id != kNoCollection) {
      closeCollection(state, scratch, state.collection(id));
    }
  }
  scratch.opened.clear();
  std::vector<OpenRegion>().swap(scratch.regions);
  scratch.open_members.clear();
  scratch.open_rows.clear();
  scratch.open.clear();
}

}  // namespace merge2d
