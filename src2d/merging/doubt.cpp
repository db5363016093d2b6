#include "src2d/merging/doubt.h"

#include <algorithm>

#include "src2d/collections/collection.h"
#include "src2d/collections/joint_welds.h"
#include "src2d/merging/decided_unmerge.h"
#include "src2d/merging/disturbance.h"
#include "src2d/merging/doubt_spread.h"
#include "src2d/proofs/coverage.h"
#include "src2d/proofs/load_certificate.h"
#include "src2d/proofs/proof_impulses.h"
#include "src2d/relaxation/open_solve.h"
#include "src2d/relaxation/passed_load.h"
#include "src2d/relaxation/proof_search.h"
#include "src2d/relaxation/reached_collection.h"

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
    if (!state.isMember(b)) return;
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
    if (!state.isMember(b)) continue;
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

/// Proofs are needed whatever the load: none is known yet, or contacts or forces have changed.
constexpr Criterion kInDoubt{"in-doubt", kOwnDecided, 1.0, 0.0, false};
/// A frame that moves drags at it.
constexpr Criterion kDragged{"dragged", kOwnDecided, 1.0, 0.0, false};

/// The doubt about a collection, with the criterion that decided it: `used` of the `known` proofs
/// have a part in the combination that is nearest to its load.
struct Finding {
  Doubt doubt = Doubt::None;
  Criterion because{};
  std::string_view verdict{};
  int used = 0, known = 0;
};

void recordFinding(const State& state, const Scratch& scratch, const Collection& c,
                   const Finding& finding) {
  if (!scratch.notes || finding.because.criterion.empty()) return;
  const BodyId first = state.firstBody(c.rigid);
  scratch.notes->decisions.push_back(record(finding.because, "WarmStart", first, first,
                                            finding.verdict,
                                            {.count = finding.used, .needed = finding.known}));
}

/// For any other load impulses are sought, unless those for a load beyond it are already, or
/// contacts can pass its new part on.
Finding seek(State& state, const Scratch& scratch, Collection& c, Finding finding,
             const CollectionLoad& load) {
  LoadCertificate& proof = c.certificate.front();
  finding.doubt = Doubt::Search;
  finding.verdict = "search";
  if (proof.search.isUnderWay() && !proof.in_doubt && leadsTo(state, c, load)) return finding;
  bringBlocksBack(state, c);
  proof.last_doubt = state.step;
  writeImpulses(c);
  if (passesOn(state, scratch, c, load)) {
    c.settled = true;
    finding.doubt = Doubt::None;
    finding.verdict = "passed";
    return finding;
  }
  beginSearch(state, c, load);
  return finding;
}

/// Joints that are soft bear more only where they give way more, whatever known proofs carry.
Criterion restsOnSoftJoints(const State& state, const Collection& c) {
  const double motion = fastestYield(state, c), most = cutSpeed(state);
  return {"proof-motion", kOwnDecided, motion, most, motion <= most};
}

/// A load that known proofs carry leaves the collection quiet, if its joints bear it too.
Finding carry(State& state, const Scratch& scratch, Collection& c, Finding finding,
              const Coverage& coverage, const CollectionLoad& load) {
  carryBy(c, coverage.weights);
  if (!c.joints.empty()) {
    writeImpulses(c);
    if (overloadsJoints(state, c)) return {Doubt::Open, kOverloaded, "open"};
    if (const Criterion rests = restsOnSoftJoints(state, c); !rests.holds) {
      finding.because = rests;
      return seek(state, scratch, c, finding, load);
    }
  }
  c.settled = true;
  finding.verdict = "carried";
  finding.doubt = c.certificate.front().search.isUnderWay() ? Doubt::Search : Doubt::None;
  return finding;
}

/// The doubt about the load of a collection in this step.
Finding findDoubt(State& state, const Scratch& scratch, Collection& c) {
  const LoadCertificate& proof = c.certificate.front();
  if (const Criterion calm = isCalm(state, c); !calm.holds) return {Doubt::Open, calm, "open"};
  c.settled = false;
  if (!isLookedAt(state, c)) return {};
  if (proof.search.isNeeded()) {
    if (isDirect(state, proof.search)) renewLoad(state, c, loadOn(state, scratch, c));
    return {Doubt::Search};
  }
  const CollectionLoad load = loadOn(state, scratch, c);
  if (proof.in_doubt) return seek(state, scratch, c, {.because = kInDoubt}, load);
  const Coverage coverage = coverageOf(state, c, load);
  Finding finding{.because = coverage.carried};
  finding.used =
      static_cast<int>(std::ranges::count_if(coverage.weights, [](double w) { return w > 0.0; }));
  finding.known = static_cast<int>(proof.witnesses.size());
  return coverage.carried.holds ? carry(state, scratch, c, finding, coverage, load)
                                : seek(state, scratch, c, finding, load);
}

/// A parked collection is asleep, and keeps a mark that nobody asks for.
void clearDoubts(const State& state, Scratch& scratch) {
  scratch.doubts.resize(state.collections.size(), Doubt::None);
  for (const std::uint32_t slot : state.collections.active()) scratch.doubts[slot] = Doubt::None;
}

/// Nothing has been sought inside for so long that its blocks are put away.
bool isLongQuiet(const State& state, const Collection& c) {
  const LoadCertificate& proof = c.certificate.front();
  return !areBlocksAway(c) &&
         state.step - std::max(proof.last_doubt, proof.since) >= kDecided.patience;
}

/// Asks each collection about its load, but for those that frames drag.
void askEach(State& state, Scratch& scratch) {
  for (Collection& c : state.collections) {
    if (!isSwept(state, c)) continue;
    openCertificate(state, c);
    Doubt& doubt = scratch.doubts[state.collections.slotOf(c)];
    if (doubt == Doubt::None) {
      const Finding finding = findDoubt(state, scratch, c);
      doubt = finding.doubt;
      recordFinding(state, scratch, c, finding);
    } else {
      c.certificate.front().search = {};  // whose load lacks the drag of the frame
      recordFinding(state, scratch, c, {doubt, kDragged, "open"});
    }
    if (doubt == Doubt::None && isLongQuiet(state, c)) putBlocksAway(c);
  }
}

/// Notes the collections that are open for the sake of another one.
void recordSpread(const State& state, const Scratch& scratch, const std::vector<Doubt>& before) {
  for (std::size_t slot = 0; slot < before.size(); ++slot) {
    if (before[slot] == Doubt::Open || scratch.doubts[slot] != Doubt::Open) continue;
    recordFinding(state, scratch, state.collections[slot], {Doubt::Open, kNeighbourHit, "open"});
  }
}

/// The blocks and impulses of collections that are in doubt.
void readyBlocks(State& state, const Scratch& scratch) {
  for (Collection& c : state.collections) {
    const Doubt doubt = doubtAbout(state, scratch, c);
    if (doubt != Doubt::Search && doubt != Doubt::Open) continue;
    bringBlocksBack(state, c);
    writeImpulses(c);
    c.certificate.front().last_doubt = state.step;
  }
}

}  // namespace

void findDoubts(State& state, Scratch& scratch) {
  notePerturbations(state, scratch);
  listOuterLoads(state, scratch);
  scratch.sweep_contacts.clear();
  scratch.sweep_joints.clear();
  clearDoubts(state, scratch);
  scratch.regions.clear();  // some are left where an error ended the last step
  scratch.open.clear();
  openWhatFramesDrag(state, scratch);
  askEach(state, scratch);
  const std::vector<Doubt> before = scratch.notes ? scratch.doubts : std::vector<Doubt>();
  noteReached(state, scratch);
  scratch.sweeping = std::ranges::any_of(state.collections.active(), [&](std::uint32_t slot) {
    return scratch.doubts[slot] != Doubt::None;
  });
  if (!scratch.sweeping) return;
  scratch.last_doubt = state.step;
  spreadHits(state, scratch);
  recordSpread(state, scratch, before);
  readyBlocks(state, scratch);
}

}  // namespace merge2d
