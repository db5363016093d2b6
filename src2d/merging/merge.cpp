#include "src2d/merging/merge.h"

#include <algorithm>

#include "src2d/collections/collection.h"
#include "src2d/contact/broadphase.h"
#include "src2d/contact/detection.h"
#include "src2d/contact/table.h"
#include "src2d/core/memory.h"
#include "src2d/cycles/held_groups.h"
#include "src2d/merging/group_notes.h"
#include "src2d/merging/ready_pairs.h"
#include "src2d/merging/rule.h"
#include "src2d/proofs/decided_settings.h"

namespace merge2d {
namespace {

/// The pairs to weld: ready, and held in the group that they would form.
std::vector<BodyPair> pairsToWeld(State& state, Scratch& scratch) {
  const CycleCriterion criterion = mergingMethod(state).cycles(state.settings.merging);
  const MergeGraph graph(state);
  listReadyPairs(state, scratch, graph);
  const std::vector<ReadyPair> pairs = pairsToJudge(state, scratch, graph);
  Groups group;
  std::vector<BodyPair> held;
  if (!pairs.empty()) group = heldGroups(graph.nodes(), graph.pinsOf(pairs), criterion);
  const auto holds = [&](const ReadyPair& edge) {
    return !group.empty() && group[edge.node_a] == group[edge.node_b];
  };
  for (const ReadyPair& edge : pairs) {
    if (holds(edge)) held.push_back(edge.pair);
  }
  if (scratch.notes) scratch.notes->judged += static_cast<int>(pairs.size());
  if (criterion != CycleCriterion::Off) noteGroups(state, scratch, group);
  std::erase_if(scratch.ready, holds);
  std::swap(state.ready_before, scratch.ready);  // those that were refused
  return held;
}

/// Welds one pair, unless its two bodies are fixed to different frames.
bool weld(State& state, const BodyPair& pair, const OnFloor& on_floor) {
  const RigidId ra = state[pair.a].rigid, rb = state[pair.b].rigid;
  const Rigid &a = state[ra], &b = state[rb];
  if (ra == rb) return false;
  if (areOnTwoFrames(a, b)) return false;
  const bool a_frame = !a.floating() && !state.isCollection(ra);
  const bool b_frame = !b.floating() && !state.isCollection(rb);
  if (a_frame) {
    anchorRigid(state, rb, pair.a);
    if (on_floor) on_floor(pair.a, pair.b);
  } else if (b_frame) {
    anchorRigid(state, ra, pair.b);
    if (on_floor) on_floor(pair.b, pair.a);
  } else {
    mergeRigids(state, ra, rb);
  }
  return true;
}

}  // namespace

void weldPairs(State& state, Scratch& scratch, const std::vector<BodyPair>& pairs) {
  weldPairs(state, scratch, pairs, {});
}

void weldPairs(State& state, Scratch& scratch, const std::vector<BodyPair>& pairs,
               const OnFloor& on_floor) {
  reserveCollections(state, pairs.size() + 1);  // two bodies are one each for a moment
  for (const BodyPair& pair : pairs) {
    if (!weld(state, pair, on_floor)) continue;
    const RigidId id = state.isMember(pair.a) ? state[pair.a].rigid : state[pair.b].rigid;
    scratch.events.push_back(
        {EventType::Merge, pair.a, pair.b, state.collection(id).id, EventReason::None});
  }
  absorbContacts(state);
}

void merge(State& state, Scratch& scratch) {
  if (!merges(state.mode)) return;
  const std::vector<BodyPair> pairs = pairsToWeld(state, scratch);
  if (!pairs.empty()) mergingMethod(state).weld(state, scratch, pairs);
  recordTwoFrames(state, scratch);
  layOutCollections(state);  // the next step starts from the layouts
  const bool released = releaseOpenRows(state, scratch, kDecided.patience);
  if (!pairs.empty()) {
    dropFreeSlots(state);
    compactContacts(state.contacts);
    collectPairs(state, scratch);
  }
  if (released || !pairs.empty()) releaseRows(state, scratch);
}

void releaseRows(State& state, Scratch& scratch) {
  compactTree(state);
  scratch.blocks.clear();
  scratch.row_sources.clear();
  scratch.block_order.clear();
  scratch.sweep_contacts.clear();
  scratch.candidates.clear();
  scratch.near_candidates.clear();
  SweepMemory& sweeps = scratch.sweeps.front();
  NncgBuffers& nncg = sweeps.nncg;
  nncg.before.clear();
  nncg.direction.clear();
  nncg.u_before.clear();
  nncg.u_direction.clear();
  sweeps.wide.release();
  scratch.open_start.clear();
  trim(scratch.blocks, scratch.row_sources, scratch.block_order, scratch.sweep_contacts,
       scratch.candidates, scratch.near_candidates, nncg.before, nncg.direction, nncg.u_before,
       nncg.u_direction, scratch.pairs, scratch.ready, scratch.u, scratch.start_motions,
       scratch.island_bodies, scratch.moved, scratch.open_start, state.broadphase.near);
}

bool releaseOpenRows(const State& state, Scratch& scratch, int kept) {
  const auto isFree = [](const SweepMemory& memory) { return memory.trial_u.empty(); };
  if (scratch.sweep_u.empty() && std::ranges::all_of(scratch.sweeps, isFree)) return false;
  if (state.step - std::max(scratch.last_sweep, scratch.last_doubt) <= kept) return false;
  const auto release = [](auto& v) { std::remove_reference_t<decltype(v)>().swap(v); };
  release(scratch.sweep_u);
  release(scratch.swept);
  release(scratch.open_start);
  release(scratch.regions);
  release(scratch.opened);
  release(scratch.open_members);
  release(scratch.open_rows);
  release(scratch.open);
  release(scratch.outer_loads);
  for (SweepMemory& memory : scratch.sweeps) release(memory.trial_u);
  scratch.newton.clear();
  return true;
}

}  // namespace merge2d
