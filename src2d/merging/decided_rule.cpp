#include "src2d/merging/decided_rule.h"

#include <algorithm>

#include "src2d/merging/collection.h"
#include "src2d/merging/decided_unmerge.h"
#include "src2d/merging/default_rule.h"
#include "src2d/merging/inner_solve.h"
#include "src2d/merging/joint_welds.h"
#include "src2d/merging/load_certificate.h"
#include "src2d/merging/refined_sweep.h"
#include "src2d/merging/sweep.h"

namespace merge2d {
namespace {

constexpr std::int16_t kLongAgo = 1000;  // steps

/// Notes what is new: a touch, a hit or an impulse; and a force that begins or ends.
void notePerturbations(State& state, const Scratch& scratch) {
  for (Collection& c : state.collections) {
    c.since_blow = std::min<std::int16_t>(kLongAgo, static_cast<std::int16_t>(c.since_blow + 1));
  }
  const auto blow = [&](BodyId b) {
    if (state.isCollection(state[b].rigid)) state.collection(state[b].rigid).since_blow = 0;
  };
  for (const Meeting& m : scratch.meetings) {
    blow(scratch.pairs[m.pair].a);
    blow(scratch.pairs[m.pair].b);
  }
  for (const Kick& kick : scratch.kicks) blow(kick.body);
  for (const BodyId b : scratch.stirred) {
    if (!state.isCollection(state[b].rigid)) continue;
    for (LoadCertificate& proof : state.collection(state[b].rigid).certificate) {
      proof.in_doubt = true;
    }
  }
}

/// A certificate without proofs for a collection that has none.
void openCertificate(const State& state, Collection& c) {
  if (!c.certificate.empty()) return;
  LoadCertificate& proof = c.certificate.emplace_back();
  if (!state[c.rigid].floating()) return;
  const auto lighter = [&](BodyId a, BodyId b) { return state[a].mass < state[b].mass; };
  proof.heaviest =
      static_cast<std::uint32_t>(std::ranges::max_element(c.members, lighter) - c.members.begin());
}

Doubt doubtAbout(const State& state, const Scratch& scratch, Collection& c) {
  openCertificate(state, c);
  LoadCertificate& proof = c.certificate.front();
  if (c.since_blow < kDecided.blow_steps || c.follow_up > 0) return Doubt::Blow;
  if (proof.in_doubt || !covers(state, c, loadOn(state, scratch, c))) return Doubt::Load;
  writeImpulses(c);
  return anyJointBreaks(state, c) ? Doubt::Load : Doubt::None;
}

/// Collections that act on each other are solved together.
void spreadDoubts(const State& state, Scratch& scratch) {
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
  for (std::uint32_t i = 0; i < slots; ++i) {
    Doubt& of_set = scratch.doubts[sets.find(i)];
    of_set = std::max(of_set, scratch.doubts[i]);
  }
  for (std::uint32_t i = 0; i < slots; ++i) {
    const bool awake = isSwept(state, state.collections[i]);
    const Doubt of_set = scratch.doubts[sets.find(i)];
    if (awake) scratch.doubts[i] = of_set;
  }
}

/// Impulses and pushes that were not looked at while the collection was quiet.
void refresh(const State& state, Collection& c) {
  writeImpulses(c);
  if (!c.certificate.front().push_stale) return;
  c.certificate.front().push_stale = false;
  layOutPush(state, c);
}

void findDoubts(State& state, Scratch& scratch) {
  notePerturbations(state, scratch);
  listOuterLoads(state, scratch);
  scratch.doubts.assign(state.collections.size(), Doubt::None);
  bool any = false;
  for (std::size_t slot = 0; slot < state.collections.size(); ++slot) {
    Collection& c = state.collections[slot];
    if (!isSwept(state, c)) continue;
    scratch.doubts[slot] = doubtAbout(state, scratch, c);
    if (scratch.doubts[slot] == Doubt::None) c.settled = true;
    any |= scratch.doubts[slot] != Doubt::None;
  }
  if (!any) return;
  spreadDoubts(state, scratch);
  for (std::size_t slot = 0; slot < state.collections.size(); ++slot) {
    if (scratch.doubts[slot] != Doubt::None && isSwept(state, state.collections[slot])) {
      refresh(state, state.collections[slot]);
    }
  }
}

bool anyDoubt(const Scratch& scratch, Doubt which) {
  return std::ranges::find(scratch.doubts, which) != scratch.doubts.end();
}

void sweepDoubted(State& state, Scratch& scratch) {
  if (anyDoubt(scratch, Doubt::Load)) solveDoubted(state, scratch);
  if (anyDoubt(scratch, Doubt::Blow)) sweepRefined(state, scratch);
}

/// A weld that was found to move slowly waits for as long as it would still seem at rest.
int waitUntilSeen(const State& state, const InternalContact& contact, const Weld* cut) {
  constexpr double kMost = 200.0;  // steps
  const int wait = kDefaultUnmerging.waitAfterSplit(state, contact, cut);
  if (!cut || cut->turning.steps == 0) return wait;
  // One step, one velocity: decided_unmerge.cpp.
  const double speed = std::max(std::abs<double>(cut->turning.sum), 1e-12);
  const double steps = std::min(kMost, state.settings.merging.velocity / speed);
  return std::max(wait, static_cast<int>(steps));
}

UnmergingMethod decided() {
  UnmergingMethod method = kDefaultUnmerging;
  method.findDoubts = findDoubts;
  method.sweep = sweepDoubted;
  method.unmerge = unmergeMovers;
  method.waitAfterSplit = waitUntilSeen;
  return method;
}

}  // namespace

const UnmergingMethod kDecidedUnmerging = decided();

}  // namespace merge2d
