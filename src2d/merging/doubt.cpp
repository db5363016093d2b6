#include "src2d/merging/doubt.h"

#include <algorithm>

#include "src2d/collections/collection.h"
#include "src2d/collections/joint_welds.h"
#include "src2d/merging/decided_unmerge.h"
#include "src2d/merging/disturbance.h"
#include "src2d/merging/doubt_spread.h"
#include "src2d/proofs/load_certificate.h"
#include "src2d/proofs/proof_impulses.h"
#include "src2d/relaxation/open_solve.h"
#include "src2d/relaxation/passed_load.h"
#include "src2d/relaxation/proof_search.h"

namespace merge2d {
namespace {

/// Whether a magnet takes hold in this step: it did not act in the last one. It holds a member
/// alone, not the whole collection. Guarded by Magnet.TakesAMemberOutOfItsCollectionAtOnce.
bool takesHoldAnew(const State& state, const BodyPair& pair) {
  if (!isBilateral(state, pair.a, pair.b)) return false;
  bool held = false;
  for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
    const Contact& contact = state.contacts[state.contacts.order[i]];
    held |= isHeld(state, contact);
    for (int k = 0; k < contact.count; ++k) {
      const ContactPoint& point = contact.points[static_cast<std::size_t>(k)];
      if (point.lambda_n != 0.0 || point.lambda_t != 0.0) return false;
    }
  }
  return held;
}

/// Notes hits, magnets that take hold, impulses, and forces that begin or end.
void notePerturbations(State& state, const Scratch& scratch) {
  const auto hit = [&](BodyId b, bool met) {
    if (!state.isCollection(state[b].rigid)) return;
    Collection& c = state.collection(state[b].rigid);
    c.hits.blow = state.step;
    if (met) c.hits.met = state.step;
  };
  for (const Meeting& m : scratch.meetings) {
    if (m.speed <= impactSpeed(state)) continue;
    hit(scratch.pairs[m.pair].a, true);
    hit(scratch.pairs[m.pair].b, true);
  }
  for (const BodyPair& pair : scratch.pairs) {
    if (!takesHoldAnew(state, pair)) continue;
    hit(pair.a, false);
    hit(pair.b, false);
  }
  for (const Kick& kick : scratch.kicks) hit(kick.body, false);
  for (const BodyId b : scratch.stirred) {
    if (!state.isCollection(state[b].rigid)) continue;
    forgetProofs(state.collection(state[b].rigid));
  }
}

/// A certificate without proofs for a collection that has none.
void openCertificate(const State& state, Collection& c) {
  if (!c.certificate.empty()) return;
  LoadCertificate& proof = c.certificate.emplace_back();
  proof.since = state.step;
  proof.heaviest = heaviestOf(state, c);
}

/// Nothing has hit it in the last steps.
Criterion isCalm(const State& state, const Collection& c) {
  const auto since = static_cast<double>(state.step - c.hits.blow);
  return {"hit", kOwnDecided, since, static_cast<double>(hitSteps(state)), !isHit(state, c)};
}

/// The record of a collection's load: `count` proofs of the `needed` ones that are known have a
/// part in the combination that is nearest to it.
void recordLoad(const State& state, const Scratch& scratch, const Collection& c,
                const Criterion& test, const LoadCertificate::Weights& weights,
                std::string_view verdict) {
  if (!scratch.notes) return;
  const BodyId first = state.firstBody(c.rigid);
  Decision d = record(test, "WarmStart", first, first, verdict);
  d.count = static_cast<int>(std::ranges::count_if(weights, [](double w) { return w > 0.0; }));
  d.needed = static_cast<int>(c.certificate.front().witnesses.size());
  scratch.notes->decisions.push_back(d);
}

/// A load that known proofs carry leaves the collection quiet, if its joints bear it too.
Doubt doubtAboutJoints(State& state, Collection& c, const Coverage& coverage) {
  carryBy(c, coverage.weights);
  if (!c.joints.empty()) {
    writeImpulses(c);
    if (overloadsJoints(state, c)) return Doubt::Open;
  }
  c.settled = true;
  const bool looks_ahead = c.certificate.front().search.isUnderWay();
  return looks_ahead ? Doubt::Search : Doubt::None;
}

/// For any other load impulses are sought, unless those for a load beyond it are already, or
/// contacts can pass on its new part.
Doubt seek(State& state, const Scratch& scratch, Collection& c, const CollectionLoad& load) {
  const LoadCertificate& proof = c.certificate.front();
  if (proof.search.isUnderWay() && !proof.in_doubt && leadsTo(state, c, load)) {
    return Doubt::Search;
  }
  bringBlocksBack(state, c);
  writeImpulses(c);
  if (passesOn(state, scratch, c, load)) {
    c.settled = true;
    return Doubt::None;
  }
  beginSearch(state, c, load);
  return Doubt::Search;
}

/// The doubt about the load of a collection in this step.
Doubt findDoubt(State& state, const Scratch& scratch, Collection& c) {
  const LoadCertificate& proof = c.certificate.front();
  if (const Criterion calm = isCalm(state, c); !calm.holds) {
    recordLoad(state, scratch, c, calm, {}, "open");
    return Doubt::Open;
  }
  c.settled = false;
  if (!isLookedAt(state, c)) return Doubt::None;
  if (proof.search.isNeeded()) {
    if (isDirect(state, proof.search)) renewLoad(state, c, loadOn(state, scratch, c));
    return Doubt::Search;
  }
  const CollectionLoad load = loadOn(state, scratch, c);
  const Coverage coverage = coverageOf(state, c, load);
  const bool carried = coverage.carried.holds && !proof.in_doubt;
  const Doubt doubt =
      carried ? doubtAboutJoints(state, c, coverage) : seek(state, scratch, c, load);
  recordLoad(state, scratch, c, coverage.carried, coverage.weights,
             doubt == Doubt::Open              ? "open"
             : carried || doubt == Doubt::None ? "carried"
                                               : "search");
  return doubt;
}

/// Nothing has been sought inside for so long that its blocks are put away in this step.
bool isLongQuiet(const State& state, const Collection& c) {
  const LoadCertificate& proof = c.certificate.front();
  return state.step - std::max(proof.last_doubt, proof.since) == kDecided.past_steps;
}

}  // namespace

void findDoubts(State& state, Scratch& scratch) {
  notePerturbations(state, scratch);
  listOuterLoads(state, scratch);
  scratch.sweep_contacts.clear();
  scratch.sweep_joints.clear();
  scratch.doubts.assign(state.collections.size(), Doubt::None);
  scratch.regions.clear();  // some are left where an error ended the last step
  scratch.open.clear();
  openWhatFramesDrag(state, scratch);
  bool any = false;
  for (Collection& c : state.collections) {
    if (!isSwept(state, c)) continue;
    openCertificate(state, c);
    Doubt& doubt = scratch.doubts[state.collections.slotOf(c)];
    if (doubt == Doubt::None) {
      doubt = findDoubt(state, scratch, c);
    } else {
      c.certificate.front().search = {};  // whose load lacks the drag of the frame
    }
    any |= doubt != Doubt::None;
    if (doubt == Doubt::None && isLongQuiet(state, c)) putBlocksAway(c);
  }
  scratch.sweeping = any;
  if (!any) return;
  scratch.last_doubt = state.step;
  spreadHits(state, scratch);
  for (Collection& c : state.collections) {
    if (doubtAbout(state, scratch, c) == Doubt::None) continue;
    bringBlocksBack(state, c);
    writeImpulses(c);
    c.certificate.front().last_doubt = state.step;
  }
}

}  // namespace merge2d
