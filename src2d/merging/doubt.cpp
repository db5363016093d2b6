#include "src2d/merging/doubt.h"

#include <algorithm>

#include "src2d/collections/collection.h"
#include "src2d/collections/joint_welds.h"
#include "src2d/merging/decided_unmerge.h"
#include "src2d/merging/disturbance.h"
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

/// A load that is covered by the witnesses leaves the collection quiet; for another one impulses
/// are sought, unless those for a load beyond it are already.
Doubt findDoubt(State& state, const Scratch& scratch, Collection& c) {
  LoadCertificate& proof = c.certificate.front();
  if (isHit(state, c)) return Doubt::Open;
  c.settled = false;
  if (!isLookedAt(state, c)) return Doubt::None;
  const bool searches = !proof.search.start.empty();
  if (searches && !proof.search.ahead && !isDirect(state, proof.search)) return Doubt::Search;
  const CollectionLoad load = loadOn(state, scratch, c);
  if (searches && !proof.search.ahead) {
    renewLoad(state, c, load);
    return Doubt::Search;
  }
  if (!proof.in_doubt && covers(state, c, load)) {
    if (!c.joints.empty()) {
      writeImpulses(c);
      if (overloadsJoints(state, c)) return Doubt::Open;
    }
    c.settled = true;
    return searches ? Doubt::Search : Doubt::None;
  }
  if (searches && !proof.in_doubt && leadsTo(state, c, load)) return Doubt::Search;
  bringBlocksBack(state, c);
  writeImpulses(c);
  if (passesOn(state, scratch, c, load)) {
    c.settled = true;
    return Doubt::None;
  }
  beginSearch(state, c, load);
  return Doubt::Search;
}

/// Nothing has been sought inside for so long that its blocks are put away in this step.
bool isLongQuiet(const State& state, const Collection& c) {
  const LoadCertificate& proof = c.certificate.front();
  return state.step - std::max(proof.last_doubt, proof.since) == kDecided.past_steps;
}

void lengthen(HitRun& run, std::int64_t step) {
  if (run.last + 1 < step) run.first = step;
  run.last = step;
}

/// A hit passes through all collections that touch each other.
void spreadDoubts(State& state, Scratch& scratch) {
  auto& sets = scratch.sets;
  sets.reset(state.collections.size());
  const auto slotOf = [&](BodyId b) -> std::ptrdiff_t {
    const RigidId id = state[b].rigid;
    if (!state.isCollection(id) || state[id].asleep) return -1;
    return static_cast<std::ptrdiff_t>(index(id) - state.bodies.size());
  };
  const auto unite = [&](BodyId a, BodyId b) {
    const auto p = slotOf(a), q = slotOf(b);
    if (p >= 0 && q >= 0) sets.unite(static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(q));
  };
  for (const BodyPair& pair : scratch.pairs) unite(pair.a, pair.b);
  for (const Joint& joint : state.joints) {
    if (!joint.to_world && holds(state, joint)) unite(joint.a, joint.b);
  }
  const auto slots = static_cast<std::uint32_t>(state.collections.size());
  std::vector<std::uint8_t> hit(slots, 0), met(slots, 0);
  for (std::uint32_t i = 0; i < slots; ++i) {
    const Collection& c = state.collections[i];
    if (!isSwept(state, c) || !isHit(state, c)) continue;
    hit[sets.find(i)] = 1;
    if (state.step - c.hits.met < hitSteps(state)) met[sets.find(i)] = 1;
  }
  for (std::uint32_t i = 0; i < slots; ++i) {
    if (!isSwept(state, state.collections[i]) || !hit[sets.find(i)]) continue;
    scratch.doubts[i] = Doubt::Open;
    if (met[sets.find(i)]) lengthen(state.collections[i].hits, state.step);
  }
}

/// Between two things that are fixed to different frames the full solve has no row, and no load
/// tells how one drags at the other: where a frame moves, it is asked with the members on their
/// own.
void openWhatFramesDrag(const State& state, Scratch& scratch) {
  const auto moves = [](const Rigid& r) {
    return r.anchor > kWorldFrame && (r.v.squaredNorm() > 0.0 || r.omega != 0.0);
  };
  for (const BodyPair& pair : scratch.pairs) {
    const Rigid &a = state.rigid(pair.a), &b = state.rigid(pair.b);
    if (!areOnTwoFrames(a, b) || !(moves(a) || moves(b))) continue;
    for (const BodyId body : {pair.a, pair.b}) {
      if (!state.isCollection(state[body].rigid)) continue;
      const Collection& c = state.collection(state[body].rigid);
      if (isSwept(state, c)) scratch.doubts[state.collections.slotOf(c)] = Doubt::Open;
    }
  }
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
  spreadDoubts(state, scratch);
  for (Collection& c : state.collections) {
    if (doubtAbout(state, scratch, c) == Doubt::None) continue;
    bringBlocksBack(state, c);
    writeImpulses(c);
    c.certificate.front().last_doubt = state.step;
  }
}

}  // namespace merge2d
