/// The rows of open collections after the full solve.

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "src2d/collections/momentum.h"
#include "src2d/core/index_set.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/relaxation/block_sweeps.h"
#include "src2d/relaxation/open_region.h"
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
  for (const std::uint32_t w : c.welds_of[member]) {
    for (const BodyId end : {c.welds[w].a, c.welds[w].b}) {
      if (scratch.open[index(end)] == 0) scratch.trial_u[index(end)] = {};
    }
  }
  scratch.trial_u[index(b)] = {u.vx, u.vy, u.omega, 1.0 / state[b].mass, 1.0 / state[b].inertia};
}

/// A tenth of the slowest motion that parts a weld of some members [m/s]: in a hit more than under
/// a load that lasts.
double toleranceFor(const State& state, const Collection& c,
                    std::span<const std::uint32_t> members) {
  double slowest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t m : members) slowest = std::min(slowest, slowestCut(state, c, m));
  return kDecided.tolerance * slowest;
}

/// A hit is followed as far as it moves anything: after each round only the rows are looked at that
/// it may have changed.
class RegionRelaxation {
 public:
  RegionRelaxation(State& state, Scratch& scratch, OpenRegion& region)
      : state_(state),
        scratch_(scratch),
        region_(region),
        c_(state.collections[region.slot]),
        sweeps_of_(scratch, c_, toleranceFor(state, c_, region.members)) {}

  double run() {
    double residual = choose(region_.members);
    double left = rowSweeps(state_, blocks_.size());
    int sweeps = 0;
    while (residual > sweeps_of_.tolerance && sweeps < kDecided.most_sweeps && left > 0.0) {
      constexpr int kRound = 10;
      const int done = sweeps_of_.run(kRound, blocks_, bodies_, scratch_.nncg, false);
      sweeps += done;
      left -= done * static_cast<double>(blocks_.size());
      residual = choose(std::vector(members_));
    }
    return residual;
  }

 private:
  /// Chooses the rows at members at which some row of `members` has a residual; returns the
  /// largest [m/s].
  double choose(const std::vector<std::uint32_t>& members) {
    double most = 0.0;
    IndexSet hot(c_.members.size());
    for (const std::uint32_t i : blocksAt(c_, members)) {
      const double residual = sweeps_of_.residual(i);
      most = std::max(most, residual);
      if (residual > sweeps_of_.tolerance) addEnds(i, hot);
    }
    blocks_ = blocksAt(c_, hot.ascending());
    IndexSet ends(c_.members.size());
    for (const std::uint32_t i : blocks_) addEnds(i, ends);
    members_ = ends.ascending();
    bodies_.clear();
    for (const std::uint32_t m : members_) {
      if (scratch_.open[index(c_.members[m])] == 0) admit(m);
      bodies_.push_back(c_.members[m]);
    }
    return most;
  }

  void addEnds(std::uint32_t block, IndexSet& members) const {
    const Weld& weld = c_.welds[c_.contacts[c_.block_contact[block]].weld];
    for (const std::uint32_t m : {weld.node_a, weld.node_b}) {
      if (m < c_.members.size()) members.add(m);
    }
  }

  void admit(std::uint32_t member) {
    const double own = kDecided.tolerance * slowestCut(state_, c_, member);
    sweeps_of_.tolerance = std::min(sweeps_of_.tolerance, own);
    addMember(state_, scratch_, region_, member);
    startRelaxed(state_, scratch_, c_, member, {});
  }

  State& state_;
  Scratch& scratch_;
  OpenRegion& region_;
  Collection& c_;
  BlockSweeps sweeps_of_;
  std::vector<std::uint32_t> blocks_, members_;  ///< that are swept
  std::vector<BodyId> bodies_;                   ///< the same members
};

/// A load that lasts may move any member.
void addAll(State& state, Scratch& scratch, OpenRegion& region) {
  const Collection& c = state.collections[region.slot];
  for (std::uint32_t m = 0; m < c.members.size(); ++m) {
    if (scratch.open[index(c.members[m])] == 0) addMember(state, scratch, region, m);
  }
}

double residualInside(Scratch& scratch, Collection& c) {
  const BlockSweeps sweeps(scratch, c, 0.0);
  double most = 0.0;
  for (std::uint32_t i = 0; i < c.blocks.size(); ++i) most = std::max(most, sweeps.residual(i));
  return most;
}

double relaxWhole(State& state, Scratch& scratch, OpenRegion& region) {
  Collection& c = state.collections[region.slot];
  const double tolerance = toleranceFor(state, c, region.members);
  const double residual = residualInside(scratch, c);
  if (residual <= tolerance) return residual;
  ProofSearch& search = c.certificate.front().search;
  ProofSearch waiting;
  if (isLarge(state, c)) std::swap(waiting, search);
  const double left = relax(state, scratch, c, tolerance);
  if (isLarge(state, c)) std::swap(waiting, search);
  return left;
}

}  // namespace

void relaxOpen(State& state, Scratch& scratch, OpenRegion& region) {
  Collection& c = state.collections[region.slot];
  const OneBody one = motionOf(state, scratch, c);
  const Rotation turn = state[c.rigid].rotation, back = turn.inverse();
  scratch.trial_u.resize(state.bodies.size() + 1);
  scratch.trial_u.back() = {};
  for (const BodyId b : c.members) scratch.trial_u[index(b)] = {};
  const bool local = isHit(state, c) && isLarge(state, c);
  if (!local) addAll(state, scratch, region);
  for (const std::uint32_t m : region.members) {
    const SolverVelocity& u = scratch.sweep_u[index(c.members[m])];
    const Vec2 v = back * Vec2(Vec2(u.vx, u.vy) - one.at(armOf(state, c, c.members[m])));
    startRelaxed(state, scratch, c, m, {v.x(), v.y(), u.omega - one.omega});
  }
  c.residual = static_cast<float>(local ? RegionRelaxation(state, scratch, region).run()
                                        : relaxWhole(state, scratch, region));
  for (const std::uint32_t m : region.members) {
    const BodyId b = c.members[m];
    const SolverVelocity& u = scratch.trial_u[index(b)];
    const Vec2 v = one.at(armOf(state, c, b)) + turn * Vec2(u.vx, u.vy);
    SolverVelocity& of = scratch.sweep_u[index(b)];
    of.vx = v.x();
    of.vy = v.y();
    of.omega = one.omega + u.omega;
  }
}

}  // namespace merge2d
