#include "src2d/merging/unmerge.h"

#include <algorithm>
#include <optional>

#include "src2d/contact/detection.h"
#include "src2d/merging/collection.h"
#include "src2d/merging/group_notes.h"
#include "src2d/merging/joint_welds.h"
#include "src2d/merging/kicked.h"
#include "src2d/merging/parts.h"
#include "src2d/merging/spare_welds.h"
#include "src2d/merging/sweep.h"
#include "src2d/merging/trial.h"
#include "src2d/merging/weld_test.h"

namespace merge2d {
namespace {

/// One event per weld that ends.
void reportCuts(const State& state, const Collection& before, Scratch& scratch) {
  for (const Weld& weld : before.welds) {
    if (stillTogether(state, weld.a, weld.b)) continue;
    scratch.events.push_back({EventType::Unmerge, weld.a, weld.b, before.id,
                              weld.cut ? weld.reason : EventReason::Cycle});
  }
  noteBrokenGroups(state, before, scratch.notes);
}

/// What was decided about welds may not be what came of it: `from` one verdict `to` another, in the
/// decisions from `first` on, where the pair stayed together.
void restate(const State& state, Notes* notes, std::size_t first, std::string_view to) {
  if (!notes) return;
  for (std::size_t i = first; i < notes->decisions.size(); ++i) {
    Decision& d = notes->decisions[i];
    if (d.verdict == "unmerge" && stillTogether(state, d.a, d.b)) d.verdict = to;
  }
}

void splitAtCuts(State& state, Scratch& scratch, RigidId id, const Parts& parts) {
  Collection before;
  before.id = state.collection(id).id;
  before.welds = state.collection(id).welds;
  std::erase_if(before.welds, [](const Weld& weld) { return weld.expected; });
  if (scratch.notes) before.contacts = state.collection(id).contacts;
  splitCollection(state, id, parts.part, parts.anchored);
  reportCuts(state, before, scratch);
  scratch.split = true;
}

/// Where more sweeps begin for the sake of the joints.
void doubtJoints(Scratch& scratch, const Collection& c) {
  for (const JointBlock& k : c.joints) {
    scratch.doubted.push_back(k.a);
    scratch.doubted.push_back(k.b);
  }
}

/// Breaks the joints that bear too much, also after more sweeps, and parts what they held.
bool breakInside(State& state, Scratch& scratch, Collection& c) {
  doubtJoints(scratch, c);
  sweepAgain(state, scratch, c);
  if (!anyJointBreaks(state, c)) return false;
  breakJointsInside(state, scratch, c);
  const Parts parts = judge(state, scratch, c);
  if (fallsApart(state, c, parts)) splitAtCuts(state, scratch, c.rigid, parts);
  scratch.split = true;  // to be laid out anew
  return true;
}

/// What seemed to part would not have moved: that is asked again, but ever less often while nothing
/// new comes in.
void refuse(Collection& c) {
  constexpr std::int8_t kMost = 5;  // 32 steps
  c.patience = static_cast<std::int8_t>(1 << c.refusals);
  c.refusals = std::min<std::int8_t>(kMost, static_cast<std::int8_t>(c.refusals + 1));
  c.refuted = true;
}

/// Whether to let what seems to part be for now.
bool waits(const State& state, Collection& c, bool disturbed) {
  if (disturbed) c.patience = c.refusals = 0;
  if (c.patience == 0 || (c.cut_welds.empty() && c.loosened.empty())) return false;
  --c.patience;
  withholdCuts(state, c);
  return true;
}

/// One sweep may not have converged: before anything parts, looks again after more, and at whether
/// it would move. `first` is the first decision of this collection.
std::optional<Parts> confirmedParts(State& state, Scratch& scratch, Collection& c, WeldTest& test,
                                    bool joints_loosened, std::size_t first) {
  restate(state, scratch.notes, first, "recheck");
  sweepAgain(state, scratch, c);
  confirmJoints(state, c, scratch.sweep_u);
  test.confirmAll();
  std::optional<Parts> parts = partsAtCuts(state, scratch, c, joints_loosened);
  c.refuted = !test.somethingGrows();
  if (!parts) return {};
  parts = partsThatMove(state, scratch, c, *parts);
  if (!parts) {
    restate(state, scratch.notes, first, "stays");
    refuse(c);
    return {};
  }
  if (!fallsApart(state, c, *parts)) return {};
  return parts;
}

/// Tests the welds of one collection, and splits it where it falls apart.
void testCollection(State& state, Scratch& scratch, std::size_t slot) {
  Collection& c = state.collections[slot];
  scratch.doubted.clear();
  for (const std::uint32_t weld : c.cut_welds) c.welds[weld].cut = false;
  c.cut_welds.clear();
  if (anyJointBreaks(state, c) && breakInside(state, scratch, c)) return;
  const bool joints_loosened = loosenJoints(state, c, scratch.sweep_u);
  if (joints_loosened) doubtJoints(scratch, c);
  const std::size_t first = scratch.notes ? scratch.notes->decisions.size() : 0;
  WeldTest test(state, scratch, c, scratch.disturbed[slot] != 0);
  test.testAll();
  const UnmergingSettings& settings = state.settings.unmerging;
  const bool confirms = settings.rule == Rule::Default && settings.ordering;
  if (confirms && !joints_loosened && waits(state, c, scratch.disturbed[slot] != 0)) {
    return restate(state, scratch.notes, first, "stays");
  }
  std::optional<Parts> parts;
  if (!confirms || !losesAMember(c)) {
    parts = partsAtCuts(state, scratch, c, joints_loosened);
    if (!parts) return;
  }
  if (confirms) parts = confirmedParts(state, scratch, c, test, joints_loosened, first);
  if (parts) splitAtCuts(state, scratch, c.rigid, *parts);
}

void finishSplits(State& state, Scratch& scratch) {
  if (!scratch.split) return;
  scratch.split = false;
  layOutFloating(state);
  collectPairs(state, scratch);
}

}  // namespace

void unmerge(State& state, Scratch& scratch) {
  if (!scratch.sweeping) return;
  const std::size_t slots = state.collections.size();
  for (std::size_t slot = 0; slot < slots; ++slot) {
    if (!isSwept(state, state.collections[slot])) continue;
    const std::size_t first = scratch.notes ? scratch.notes->decisions.size() : 0;
    testCollection(state, scratch, slot);
    restate(state, scratch.notes, first, "cut");  // cut, but held together by others
  }
  finishSplits(state, scratch);
  forgetExpectedContacts(state, scratch);
}

void releaseBody(State& state, Scratch& scratch, BodyId body) {
  const std::size_t slots = state.collections.size();
  for (std::size_t slot = 0; slot < slots; ++slot) {
    Collection& c = state.collections[slot];
    if (c.id == kNoCollection) continue;
    bool any = false;
    for (Weld& weld : c.welds) {
      if (weld.a != body && weld.b != body) continue;
      weld.cut = any = true;
      weld.reason = EventReason::User;
    }
    if (any) splitAtCuts(state, scratch, c.rigid, judge(state, scratch, c));
  }
  finishSplits(state, scratch);
  layOutCollections(state);
}

}  // namespace merge2d
