#include "src2d/merging/decided_unmerge.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

#include "src2d/collections/cuts.h"
#include "src2d/collections/joint_welds.h"
#include "src2d/dynamics/contact_limits.h"
#include "src2d/merging/weld_motion.h"
#include "src2d/proofs/load_certificate.h"
#include "src2d/proofs/proof_impulses.h"
#include "src2d/relaxation/open_region.h"
#include "src2d/relaxation/open_solve.h"
#include "src2d/relaxation/proof_search.h"

namespace merge2d {
namespace {

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
Criterion staysTogether(const WeldMotion& motion, double limit) {
  return {"motion", kOwnDecided, motion.most, limit, motion.most <= limit};
}

/// Motion may be an error of the solve where it is no faster than `noise` at one of the two boxes.
Criterion mayBeNoise(const WeldMotion& motion, double noise) {
  return {"noise", kOwnDecided, motion.least, noise, motion.least <= noise};
}

/// The bodies of a weld do not move in the search that opened their collection, of which the
/// residual is small: that of the full solve may not be.
Criterion restsInSearch(bool moves) {
  return {"search-mover", kOwnDecided, moves ? 1.0 : 0.0, 1.0, !moves};
}

/// Why a weld stays: the first of these that holds; or that its bodies part.
Criterion whyItStays(const WeldMotion& motion, double limit, double noise, bool moves_in_search) {
  const Criterion slow = staysTogether(motion, limit);
  if (slow.holds) return slow;
  const Criterion noisy = mayBeNoise(motion, noise);
  if (noisy.holds) return noisy;
  const Criterion rests = restsInSearch(moves_in_search);
  return rests.holds ? rests : slow;
}

void recordWeld(const Scratch& scratch, const Weld& weld, const Criterion& test) {
  if (!scratch.notes) return;
  const std::string_view verdict = test.holds ? "keep" : "unmerge";
  scratch.notes->decisions.push_back(
      record(test, "Unmerge", weld.a, weld.b, verdict, {.count = test.holds ? 0 : 1}));
}

/// Below this motion is an error of the solve [m/s]: its residual, but for a hit. While a search
/// goes on some weld must move by more than a few residuals.
double noiseOf(const State& state, const Collection& c, std::span<const std::uint32_t> welds,
               const WeldMotions& motions, const ProofSearch& search) {
  const double residual = c.hits.blow == state.step ? 0.0 : c.residual;
  const double sure = residual / kDecided.tolerance;
  const auto surelyMoves = [&](std::uint32_t i) { return motions.turns(c.welds[i], sure); };
  return search.isUnderWay() && std::ranges::none_of(welds, surelyMoves) ? sure : residual;
}

/// Cuts the welds whose bodies move. True where some are cut.
bool cutMovers(const State& state, Scratch& scratch, Collection& c, const OpenRegion& region,
               const ProofSearch& search) {
  const WeldMotions motions(state, c, scratch.sweeps.front().trial_u);
  const std::vector<std::uint32_t> welds = weldsAt(c, region.members);
  const double noise = noiseOf(state, c, welds, motions, search);
  bool any = false;
  for (const std::uint32_t i : welds) {
    Weld& weld = c.welds[i];
    weld.cut = false;
    weld.motion = 0.0F;
    if (weld.expected) continue;
    const double limit = motions.limitOf(weld);
    const WeldMotion motion = motions.of(weld, scratch.notes ? 0.0 : limit);
    const bool moves_in_search = !search.hasFoundMotion() || search.movers[i] != 0;
    const Criterion stays = whyItStays(motion, limit, noise, moves_in_search);
    recordWeld(scratch, weld, stays);
    if (stays.holds) continue;
    weld.cut = any = true;
    weld.motion = static_cast<float>(motion.most);
    weld.reason = reasonOfCut(c, weld);
  }
  return any;
}

/// For how many steps it has been hit without a break: it stays open for some after the last hit.
std::int64_t stepsOfHits(const State& state, const Collection& c) {
  return c.hits.last - c.hits.first + 2 - hitSteps(state);
}

/// A collection is not hit, or for less time than DecidedSettings::lasting. Hits that open only a
/// small part of it do not count.
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
  if (state.joints.empty()) return false;
  bool any = false;
  for (const BodyId member : c.members) {
    state.joint_lists.of_body.forEach(member, [&](std::uint32_t i) {
      any |= holds(state, state.joints[i]) && !isInside(state, state.joints[i]);
    });
  }
  return any;
}

/// The fastest motion of a weld that turns by more than `noise` [m/s], or 0.
double fastestTurn(const State& state, const SweepMemory& memory, const Collection& c,
                   double noise) {
  const WeldMotions motions(state, c, memory.trial_u);
  double fastest = 0.0;
  for (const Weld& weld : c.welds) {
    if (!motions.turns(weld, noise)) continue;
    fastest = std::max(fastest, motions.of(weld, 0.0).most);
  }
  return fastest;
}

/// Nothing moves in a search. Welds that may turn are looked at more closely, for one step more.
Criterion restsIn(const State& state, const SearchTools& tools, Collection& c) {
  const SweepMemory& memory = tools.sweeps.memory;
  const double tolerance = toleratedResidual(state), cut = cutSpeed(state);
  const auto moves = [](double motion, double most) {
    return Criterion{"search-motion", kOwnDecided, motion, most, motion <= most};
  };
  const auto sure = [&] { return c.residual / kDecided.tolerance; };
  const Criterion rests = moves(fastestContact(memory, c), std::max(cut, sure()));
  if (!rests.holds || c.residual > tolerance) return rests;
  if (fastestTurn(state, memory, c, c.residual) == 0.0) return rests;
  continueSearch(state, tools, c, kDecided.tolerance * tolerance);
  const double turn = fastestTurn(state, memory, c, sure());
  return turn > 0.0 ? moves(turn, cut) : rests;
}

/// The record of a search for the load of a step, with its step; none of one that looks ahead.
void recordSearch(const State& state, Notes* notes, const Collection& c, const ProofSearch& search,
                  const Criterion& test, std::string_view verdict) {
  if (!notes || search.ahead) return;
  const BodyId first = state.firstBody(c.rigid);
  notes->decisions.push_back(
      record(test, "SingleIterationPGS", first, first, verdict, {.count = search.steps}));
}

/// Hits were followed in an island with members of an open collection that floats: all of these
/// have gone ways of their own. Guarded by Collection.MergesAndUnmergesConserveMomentum.
bool areHitsFollowedThrough(const State& state, const Scratch& scratch) {
  return std::ranges::any_of(scratch.hit_ways, [&](const HitWay& hit) {
    if (index(hit.id) >= state.bodies.size()) return false;
    const BodyId body{static_cast<std::uint32_t>(hit.id)};
    return state.isMember(body) && state.rigid(body).floating();
  });
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
  const Criterion resting = restsIn(state, tools, c);
  const bool rests = resting.holds;
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
    const Criterion& why = rests ? kOverloaded : resting;
    recordSearch(state, tools.notes, c, search, why, "open");
  }
  if (rests) prove(state, c, std::move(search.load));
  return c.settled;
}

void unmergeMovers(State& state, Scratch& scratch) {
  if (scratch.regions.empty()) return;
  const bool hits = areHitsFollowedThrough(state, scratch);
  bool stay = true, jointed = false;
  for (const OpenRegion& region : scratch.regions) {
    jointed |= hasJointsOutside(state, state.collections[region.slot]);
    stay &= decideOne(state, scratch, region);
  }
  closeOpened(state, scratch);
  // The sum of momenta knows nothing of joints: a collection that stays whole is solved once more.
  // Nor does it know where in the step the members of a floating one were when they were hit.
  if ((stay && jointed) || hits) scratch.solved = false;
}

}  // namespace merge2d
