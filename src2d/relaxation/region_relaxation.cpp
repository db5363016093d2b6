/// The rows of open collections after the full solve.

#include <algorithm>
#include <limits>
#include <span>

#include "src2d/collections/momentum.h"
#include "src2d/dynamics/thread_memory.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/relaxation/block_sweeps.h"
#include "src2d/relaxation/open_region.h"
#include "src2d/relaxation/open_solve.h"
#include "src2d/relaxation/reached_rows.h"
#include "src2d/relaxation/region_members.h"
#include "src2d/relaxation/relaxation.h"

namespace merge2d {
namespace {

/// The motion of an open collection as one body: that of its frame, or of its members' momentum.
/// Seen from the centre of mass, so that the rounding does not depend on where that is.
struct OneBody {
  Vec2 v = Vec2::Zero();
  double omega = 0.0;
  Vec2 at(const Vec2& arm) const { return v + cross(omega, arm); }
};

OneBody motionOf(const State& state, const Scratch& scratch, const Collection& c) {
  const Rigid& r = state[c.rigid];
  if (r.floating()) {
    const VelocityField field = sweptField(state, scratch, c);
    return {field.v, field.omega};
  }
  if (r.anchor == kWorldFrame) return {};
  const Rigid& anchor = state[rigidOf(c.anchor)];
  return {anchor.v, anchor.omega};
}

/// From the centre of mass, or the frame's origin.
Vec2 armOf(const State& state, const Collection& c, BodyId b) {
  const Rigid& r = state[c.rigid];
  return r.rotation * (state[b].local - (r.floating() ? r.center : Vec2(Vec2::Zero())));
}

/// A member of the region, seen from the collection; its neighbours outside do not move.
void startRelaxed(const State& state, Scratch& scratch, const Collection& c, std::uint32_t member,
                  const Twist& u) {
  const BodyId b = c.members[member];
  auto& trial_u = scratch.sweeps.front().trial_u;
  for (const std::uint32_t w : c.welds_of[member]) {
    for (const BodyId end : {c.welds[w].a, c.welds[w].b}) {
      if (scratch.open[index(end)] == 0) trial_u[index(end)] = {};
    }
  }
  trial_u[index(b)] = memberVelocity(state, b, u);
}

/// A tenth of the slowest motion that parts a weld of some members [m/s]: in a hit more than under
/// a load that lasts.
double toleranceFor(const State& state, const Collection& c,
                    std::span<const std::uint32_t> members) {
  double slowest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t m : members) slowest = std::min(slowest, slowestCut(state, c, m));
  return kDecided.tolerance * slowest;
}

/// A hit is followed as far as it moves anything.
double relaxRegion(State& state, Scratch& scratch, OpenRegion& region) {
  Collection& c = state.collections[region.slot];
  BlockSweeps sweeps_of(ownTools(scratch), c, toleranceFor(state, c, region.members));
  ReachedRows reached(sweeps_of, c, [&](std::uint32_t member) {
    if (scratch.open[index(c.members[member])] != 0) return;
    const double own = kDecided.tolerance * slowestCut(state, c, member);
    sweeps_of.tolerance = std::min(sweeps_of.tolerance, own);
    addMember(state, scratch, region, member);
    startRelaxed(state, scratch, c, member, {});
  });
  double residual = reached.look(blocksAt(c, region.members));
  auto budget = SweepBudget::ofStep(state, reached.blocks().size());
  while (residual > sweeps_of.tolerance && !budget.isSpent()) {
    const int done = sweeps_of.run(ReachedRows::kRound, reached.blocks(), reached.bodies(),
                                   scratch.sweeps.front().nncg, false);
    budget.spend(done, reached.blocks().size());
    residual = reached.lookAgain();
  }
  return residual;
}

/// In a small collection a search that is under way goes on, with its gradient and its budget.
double relaxWhole(State& state, Scratch& scratch, OpenRegion& region) {
  Collection& c = state.collections[region.slot];
  const SweepTools tools = ownTools(scratch);
  const double tolerance = toleranceFor(state, c, region.members);
  const double residual = BlockSweeps(tools, c, tolerance).largestResidual();
  if (residual <= tolerance) return residual;
  ProofSearch& search = c.certificate.front().search;
  const std::size_t rows = c.blocks.size();
  if (search.isUnderWay() && !isLarge(state, c)) {
    const auto budget = SweepBudget::ofSearch(state, rows, search.steps);
    return relax(state, tools, c, tolerance, budget, &search);
  }
  const auto budget =
      isHit(state, c) ? SweepBudget::ofStep(state, rows) : SweepBudget::ofOpened(state, rows);
  return relax(state, tools, c, tolerance, budget, nullptr);
}

}  // namespace

void relaxOpen(State& state, Scratch& scratch, OpenRegion& region) {
  Collection& c = state.collections[region.slot];
  const bool local = isHit(state, c) && isLarge(state, c);
  if (local && region.members.empty()) {
    c.residual = 0.0F;
    return;
  }
  const OneBody one = motionOf(state, scratch, c);
  const Rotation turn = state[c.rigid].rotation, back = turn.inverse();
  auto& trial_u = scratch.sweeps.front().trial_u;
  trial_u.resize(state.bodies.size() + 1);
  trial_u.back() = {};
  if (!local) {  // a load that lasts may move any member
    showRest(state, scratch, c);
    addOthers(state, scratch, region);
  }
  for (const std::uint32_t m : region.members) {
    const SolverVelocity& u = scratch.sweep_u[index(c.members[m])];
    const Vec2 v = back * Vec2(Vec2(u.vx, u.vy) - one.at(armOf(state, c, c.members[m])));
    startRelaxed(state, scratch, c, m, {v.x(), v.y(), u.omega - one.omega});
  }
  c.residual = static_cast<float>(local ? relaxRegion(state, scratch, region)
                                        : relaxWhole(state, scratch, region));
  for (const std::uint32_t m : region.members) {
    const BodyId b = c.members[m];
    const SolverVelocity& u = trial_u[index(b)];
    const Vec2 v = one.at(armOf(state, c, b)) + turn * Vec2(u.vx, u.vy);
    SolverVelocity& of = scratch.sweep_u[index(b)];
    of.vx = v.x();
    of.vy = v.y();
    of.omega = one.omega + u.omega;
    scratch.swept[index(b)] = 1;
  }
}

}  // namespace merge2d
