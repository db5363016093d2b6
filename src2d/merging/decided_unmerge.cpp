#include "src2d/merging/decided_unmerge.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "src2d/collections/cuts.h"
#include "src2d/collections/joint_welds.h"
#include "src2d/dynamics/contact_limits.h"
#include "src2d/merging/metric.h"
#include "src2d/proofs/load_certificate.h"
#include "src2d/proofs/proof_impulses.h"
#include "src2d/relaxation/open_region.h"
#include "src2d/relaxation/open_solve.h"
#include "src2d/relaxation/proof_search.h"

namespace merge2d {
namespace {

/// How fast the two bodies of a weld move against each other at the corners of their boxes: of the
/// box where this is most, and of the one where it is least [m/s].
struct WeldMotion {
  double most = 0.0, least = 0.0;
};

class WeldMotions {
 public:
  WeldMotions(const State& state, const Collection& c, const std::vector<SolverVelocity>& u)
      : state_(state), c_(c), u_(u) {}

  /// The speed at which the bodies of a weld part [m/s].
  double limitOf(const Weld& weld) const { return cutSpeed(state_, c_, weld); }

  /// Zero where a bound tells that nothing is faster than `ignored`.
  WeldMotion of(const Weld& weld, double ignored) const {
    const Vec2 origin = state_[isMember(weld.a) ? weld.a : weld.b].local;
    const VelocityField a = field(weld.a, origin), b = field(weld.b, origin);
    const double linear = (b.v - a.at(b.x)).norm(), turning = std::abs(b.omega - a.omega);
    if (linear + turning * reachFrom(origin + b.x, weld) <= ignored) return {};
    WeldMotion motion{0.0, std::numeric_limits<double>::infinity()};
    for (const BodyId id : {weld.a, weld.b}) {
      if (!isMember(id)) continue;
      const double speed = fastestCorner(boxOf(id, origin), a, b);
      motion = {std::max(motion.most, speed), std::min(motion.least, speed)};
    }
    return motion;
  }

 private:
  bool isMember(BodyId b) const { return state_[b].rigid == c_.rigid; }

  /// Seen from an origin near by, so that the rounding does not depend on where the frame's is. The
  /// bodies of the frame are at rest.
  VelocityField field(BodyId b, const Vec2& origin) const {
    if (!isMember(b)) return {};
    const SolverVelocity& u = u_[index(b)];
    return {state_[b].local - origin, {u.vx, u.vy}, u.omega};
  }

  /// The box of a member.
  OrientedBox boxOf(BodyId b, const Vec2& origin) const {
    OrientedBox box = state_.extent(rigidOf(b)).box;
    box.frame = Pose{state_[b].local - origin, state_[b].local_rotation} * box.frame;
    return box;
  }

  /// No corner of a member is farther away than this [m].
  double reachFrom(const Vec2& x, const Weld& weld) const {
    double reach = 0.0;
    for (const BodyId id : {weld.a, weld.b}) {
      if (!isMember(id)) continue;
      const OrientedBox& box = state_.extent(rigidOf(id)).box;
      const double radius = box.frame.position.norm() + box.half.norm();
      reach = std::max(reach, (state_[id].local - x).norm() + radius);
    }
    return reach;
  }

  const State& state_;
  const Collection& c_;
  const std::vector<SolverVelocity>& u_;
};

/// Why a weld ends: broken where nothing presses, sliding where a contact is on the edge of its
/// cone.
EventReason reasonOfCut(const Collection& c, const Weld& weld) {
  bool presses = weld.joints > 0, slides = false;
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    const ContactBlock& k = c.blocks[c.contacts[i].block];
    for (int p = 0; p < k.count; ++p) {
      presses |= !broken(k, p);
      slides |= !broken(k, p) && onEdge(k, p);
    }
  }
  if (!presses) return EventReason::Broken;
  return slides ? EventReason::Sliding : EventReason::RelativeMotion;
}

/// The bodies of a weld do not part.
Criterion staysTogether(double speed, double limit) {
  return {"motion", kOwnDecided, speed, limit, speed <= limit};
}

void recordWeld(const Scratch& scratch, const Weld& weld, const Criterion& test) {
  if (!scratch.notes) return;
  const std::string_view verdict = test.holds ? "keep" : "unmerge";
  scratch.notes->decisions.push_back(
      record(test, "Unmerge", weld.a, weld.b, verdict, {.count = test.holds ? 0 : 1}));
}

/// The bodies of a weld move against each other, at their corners, by more than `noise`: a beam
/// that begins to tip about its pivot hardly moves there.
bool turns(const Weld& weld, const WeldMotions& motions, double noise) {
  const double limit = motions.limitOf(weld);
  const WeldMotion motion = motions.of(weld, limit);
  return !weld.expected && motion.most > limit && motion.least > noise;
}

/// Cuts the welds whose bodies move. Motion slower than the residual may be an error of the solve.
/// Where a search has found motion, so may the motion of welds that did not move in it. While one
/// goes on, some weld must move by more than a few residuals. True where some are cut.
bool cutMovers(const State& state, Scratch& scratch, Collection& c, const OpenRegion& region,
               const ProofSearch& search) {
  const WeldMotions motions(state, c, scratch.sweeps.front().trial_u);
  const double residual = c.hits.blow == state.step ? 0.0 : c.residual;
  const std::vector<std::uint32_t> welds = weldsAt(c, region.members);
  const bool moves = !search.isUnderWay() || std::ranges::any_of(welds, [&](std::uint32_t i) {
    return turns(c.welds[i], motions, residual / kDecided.tolerance);
  });
  bool any = false;
  for (const std::uint32_t i : welds) {
    Weld& weld = c.welds[i];
    weld.cut = false;
    weld.motion = 0.0F;
    if (weld.expected) continue;
    const double limit = motions.limitOf(weld);
    const WeldMotion motion = motions.of(weld, scratch.notes ? 0.0 : limit);
    const double speed = moves && motion.least > residual ? motion.most : 0.0;
    const Criterion stays = staysTogether(speed, limit);
    recordWeld(scratch, weld, stays);
    if (stays.holds) continue;
    if (search.hasFoundMotion() && search.movers[i] == 0) continue;
    weld.cut = true;
    weld.motion = static_cast<float>(speed);
    weld.reason = reasonOfCut(c, weld);
    any = true;
  }
  return any;
}

/// For how many steps it has been hit without a break: it stays open for some after the last hit.
std::int64_t stepsOfHits(const State& state, const Collection& c) {
  return c.hits.last - c.hits.first + 2 - hitSteps(state);
}

/// It is not hit, or for less than what lasts (DecidedSettings::lasting); of one of which a hit
/// opens but a part that does not matter.
Criterion isHitBriefly(const State& state, const Collection& c) {
  const std::int64_t steps = stepsOfHits(state, c);
  const bool for_long = c.hits.last == state.step && lasts(state, steps) && !opensInPart(state, c);
  const double time = static_cast<double>(steps) * state.h;
  return {"hits", kOwnDecided, time, kDecided.lasting, !for_long};
}

/// Cuts all welds but those that joints alone hold rigid: the bodies are simulated one by one, and
/// a pair of them waits as one does that parted slowly. Guarded by
/// StepBack.BodiesThatAreHitForLongAreSimulatedOneByOne.
void stepBack(const State& state, Scratch& scratch, Collection& c, const Criterion& brief) {
  constexpr int kRigid = 2;
  for (Weld& weld : c.welds) {
    if (weld.expected || weld.joints >= kRigid) continue;
    recordWeld(scratch, weld, brief);
    if (!weld.cut) weld.reason = reasonOfCut(c, weld);
    weld.cut = true;
    weld.motion = static_cast<float>(state.settings.merging.velocity / kDecided.patience);
  }
  c.hits.endRun();
}

/// Where no part comes off.
void forgetCuts(Collection& c) {
  for (Weld& weld : c.welds) weld.cut = false;
}

/// Keeps a proof, and looks whether a load beyond it is carried too: one that swings then finds its
/// proof before it gets there. Not just after a layout, as most of a heap that still forms are laid
/// out anew soon.
void prove(const State& state, Collection& c, Witness&& witness) {
  LoadCertificate& proof = c.certificate.front();
  proof.in_doubt = false;
  const bool goes_on = proof.inherited < proof.witnesses.size() &&
                       state.step - proof.since >= state.settings.merging.steps;
  Witness load = goes_on ? witness : Witness();
  remember(state, c, std::move(witness));
  carryByLatest(c);
  if (!goes_on) return;
  double way = 0.0;
  Witness next = beyond(proof, load, kDecided.overshoot, way);
  beginSearchAhead(state, c, std::move(next), way);
}

/// How fast the members of the trial move, at contacts and at the corners of welds; turning about a
/// contact of a body beside which the other hardly moves is left to the residual [m/s].
double fastestOf(const State& state, const SweepMemory& memory, const Collection& c) {
  const WeldMotions motions(state, c, memory.trial_u);
  double most = fastestContact(memory, c);
  for (const Weld& weld : c.welds) {
    if (weld.expected) continue;
    const WeldMotion motion = motions.of(weld, 0.0);
    if (motion.least > toleratedResidual(state)) most = std::max(most, motion.most);
  }
  return most;
}

/// The rows inside are solved so far that less than a tenth of the slowest motion that cuts is
/// left.
Criterion hasConverged(const State& state, const Collection& c) {
  const auto residual = static_cast<double>(c.residual);
  const double most = toleratedResidual(state);
  return {"residual", kOwnDecided, residual, most, residual <= most};
}

/// No part comes off in the full solve: a proof, where that has converged to rest. A search that
/// had not goes on; one that had, with the load of an earlier step, begins anew.
void keepTogether(const State& state, Scratch& scratch, Collection& c, const OpenRegion& region,
                  ProofSearch&& search) {
  LoadCertificate& proof = c.certificate.front();
  const bool converged = hasConverged(state, c).holds;
  const bool hit = isHit(state, c);
  const double motion = converged && !hit ? fastestOf(state, scratch.sweeps.front(), c) : 0.0;
  c.settled = !hit && converged && motion <= cutSpeed(state);
  if (c.settled) {
    Witness witness = asWitness(state, c, loadOn(state, scratch, c));
    witness.motion = motion;
    readImpulses(c, witness);
    return prove(state, c, std::move(witness));
  }
  proof.in_doubt |= !hit || proof.witnesses.empty();
  if (hit || !search.isUnderWay() || converged) return;
  restoreImpulses(state, c, region, search.load);
  proof.search = std::move(search);
}

/// Where the solve has not converged, only motion that is above its residual counts. True where no
/// part comes off under a load that lasts.
bool decideOne(State& state, Scratch& scratch, const OpenRegion& region) {
  Collection& c = state.collections[region.slot];
  LoadCertificate& proof = c.certificate.front();
  ProofSearch before = std::exchange(proof.search, {});
  if (breakJointsInside(state, scratch, c)) return false;
  if (!c.joints.empty()) loosenJoints(state, c, scratch.sweep_u);
  Noted noted(scratch.notes);
  bool moves = cutMovers(state, scratch, c, region, before);
  if (const Criterion brief = isHitBriefly(state, c); !brief.holds) {
    stepBack(state, scratch, c, brief);
    moves = true;
  }
  noted.close();
  if (isHit(state, c)) {
    restoreImpulses(state, c, region, before.load);  // a hit is no load that lasts
  } else {
    c.push.forget();
  }
  const Parts parts = moves ? componentsOf(c) : Parts();
  const bool parting = moves && fallsApart(state, c, parts);
  if (parting) {
    c.settled = false;
    showRest(state, scratch, c);
    splitAtCuts(state, scratch, c.rigid, parts);
  } else {
    if (moves) forgetCuts(c);
    keepTogether(state, scratch, c, region, std::move(before));
  }
  restate(state, noted, "cut");
  return !parting && !isHit(state, c);
}

bool hasJointsOutside(const State& state, const Collection& c) {
  return std::ranges::any_of(state.joints, [&](const Joint& joint) {
    const bool at =
        state[joint.a].rigid == c.rigid || (!joint.to_world && state[joint.b].rigid == c.rigid);
    return at && holds(state, joint) && !isInside(state, joint);
  });
}

/// Whether nothing moves in a search. What may turn is looked at more closely, for one step more.
bool restsIn(const State& state, const SearchTools& tools, Collection& c) {
  const SweepMemory& memory = tools.sweeps.memory;
  const double tolerance = toleratedResidual(state);
  const auto sure = [&] { return c.residual / kDecided.tolerance; };
  if (fastestContact(memory, c) > std::max(cutSpeed(state), sure())) return false;
  const WeldMotions motions(state, c, memory.trial_u);
  const auto turnsBy = [&](double noise) {
    return std::ranges::any_of(c.welds, [&](const Weld& w) { return turns(w, motions, noise); });
  };
  if (c.residual > tolerance || !turnsBy(c.residual)) return true;
  continueSearch(state, tools, c, kDecided.tolerance * tolerance);
  return !turnsBy(sure());
}

/// The fastest motion that a search has found, of one that was told to have found some (restsIn).
Criterion movesNowhere(const State& state, const SweepMemory& memory, const Collection& c) {
  return {"search-motion", kOwnDecided, fastestOf(state, memory, c), cutSpeed(state), false};
}

/// The record of a search for the load of a step, with its step; none of one that looks ahead.
void recordSearch(const State& state, Notes* notes, const Collection& c, const ProofSearch& search,
                  const Criterion& test, std::string_view verdict) {
  if (!notes || search.ahead) return;
  const BodyId first = state.firstBody(c.rigid);
  notes->decisions.push_back(
      record(test, "SingleIterationPGS", first, first, verdict, {.count = search.steps}));
}

/// Per weld: whether its bodies move in a search.
std::vector<std::uint8_t> moversOf(const State& state, const SweepMemory& memory,
                                   const Collection& c) {
  const WeldMotions motions(state, c, memory.trial_u);
  std::vector<std::uint8_t> movers;
  movers.reserve(c.welds.size());
  for (const Weld& weld : c.welds) {
    const double limit = motions.limitOf(weld);
    movers.push_back(motions.of(weld, limit).most > limit ? 1 : 0);
  }
  return movers;
}

}  // namespace

bool overloadsJoints(State& state, const Collection& c) {
  for (const JointBlock& k : c.joints) state.joints[k.joint].lambda = k.lambda;
  return anyJointBreaks(state, c);
}

bool endSearch(State& state, const SearchTools& tools, Collection& c) {
  const SweepMemory& memory = tools.sweeps.memory;
  LoadCertificate& proof = c.certificate.front();
  if (proof.search.isSuspended()) return true;
  const bool rests = restsIn(state, tools, c);
  const Criterion converged = hasConverged(state, c);
  if (rests && !converged.holds) {
    recordSearch(state, tools.notes, c, proof.search, converged, "search");
    c.settled = proof.search.ahead;
    return true;  // it goes on
  }
  ProofSearch search = std::exchange(proof.search, {});
  if (rests) search.load.motion = fastestOf(state, memory, c);
  if (search.ahead) {
    c.settled = true;
    if (rests) remember(state, c, std::move(search.load));
    return true;
  }
  if (!rests) proof.search.movers = moversOf(state, memory, c);
  readImpulses(c, search.load);
  c.settled = rests && !overloadsJoints(state, c);
  if (c.settled) {
    recordSearch(state, tools.notes, c, search, converged, "carried");
  } else if (tools.notes) {
    const Criterion why = rests ? kOverloaded : movesNowhere(state, memory, c);
    recordSearch(state, tools.notes, c, search, why, "open");
  }
  if (rests) prove(state, c, std::move(search.load));
  return c.settled;
}

void unmergeMovers(State& state, Scratch& scratch) {
  if (scratch.regions.empty()) return;
  bool stay = true, jointed = false;
  for (const OpenRegion& region : scratch.regions) {
    jointed |= hasJointsOutside(state, state.collections[region.slot]);
    stay &= decideOne(state, scratch, region);
  }
  closeOpened(state, scratch);
  // The sum of momenta knows nothing of joints: a collection that stays whole is solved once more.
  if (stay && jointed) scratch.solved = false;
}

}  // namespace merge2d
