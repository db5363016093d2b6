#include "src2d/merging/default_unmerge.h"

#include <algorithm>
#include <optional>

#include "src2d/merging/caution.h"
#include "src2d/merging/cuts.h"
#include "src2d/merging/disturbance.h"
#include "src2d/merging/footing.h"
#include "src2d/merging/joint_welds.h"
#include "src2d/merging/refined_sweep.h"
#include "src2d/merging/spare_welds.h"
#include "src2d/merging/sweep.h"
#include "src2d/merging/trial.h"
#include "src2d/merging/weld_checks.h"

namespace merge2d {
namespace {

bool isCut(const Collection& c, BodyId a, BodyId b) {
  return std::ranges::any_of(c.cut_welds, [&](std::uint32_t weld) {
    return c.welds[weld].a == a && c.welds[weld].b == b;
  });
}

/// Doubts the bodies at all joints, so that more sweeps begin there too.
void doubtJoints(Scratch& scratch, const Collection& c) {
  for (const JointBlock& k : c.joints) {
    scratch.doubted.push_back(k.a);
    scratch.doubted.push_back(k.b);
  }
}

/// Breaks the joints that bear too much, also after more sweeps.
bool breakInside(State& state, Scratch& scratch, Collection& c) {
  doubtJoints(scratch, c);
  sweepAgain(state, scratch, c);
  return breakJointsInside(state, scratch, c);
}

/// Doubles the wait before the trial is asked again (back-off): the parts of this collection would
/// not have moved.
void refuse(Collection& c) {
  c.patience = static_cast<std::int8_t>(1 << c.refusals);
  c.refusals =
      std::min<std::int8_t>(Collection::kMostRefusals, static_cast<std::int8_t>(c.refusals + 1));
  c.refuted = true;
}

/// Forgets refusals one by one while no weld is cut, or others hold its bodies together.
void forgetRefusals(const State& state, Collection& c) {
  constexpr std::int64_t kEvery = 256;  // steps
  if (c.refusals == 0 || state.step % kEvery != 0) return;
  --c.refusals;
  c.patience = std::min(c.patience, static_cast<std::int8_t>(1 << c.refusals));
}

/// Whether the collection waits for the next trial, with all cuts withheld. Cuts at bodies that are
/// jolted in this step do not wait: a heap on which things fall is always disturbed somewhere, and
/// the rest of it waits on.
bool waits(const State& state, Collection& c, bool disturbed, Noted& noted) {
  if (disturbed && isJolted(state, c)) c.patience = c.refusals = 0;
  if (c.cut_welds.empty() && c.loosened.empty()) {
    forgetRefusals(state, c);
    return false;
  }
  if (c.patience == 0) return false;
  --c.patience;
  const bool all = withholdCuts(state, c);
  noted.close();
  restate(noted, "stays", [&](const Decision& d) { return !isCut(c, d.a, d.b); });
  return all;
}

/// One collection, tested.
struct Tested {
  std::size_t slot;
  Noted noted;
  bool apart = false;  ///< falls into `parts`
  Parts parts = {};
  bool sure = false;  ///< even where the trial finds no motion

  void fallsInto(Parts&& found) {
    apart = true;
    parts = std::move(found);
  }
};

/// Tests the welds again after more sweeps before anything parts: one sweep may not have converged.
std::optional<Parts> confirmedParts(State& state, Scratch& scratch, Collection& c, WeldTest& test,
                                    bool joints_loosened, Noted& noted) {
  noted.close();
  restate(state, noted, "recheck");
  sweepAgain(state, scratch, c);
  confirmJoints(state, c, scratch.sweep_u);
  test.confirmAll();
  listOthers(state, scratch, c);
  const bool anew = joints_loosened || losesAMember(c, scratch);
  std::optional<Parts> parts = partsAtCuts(state, scratch, c, anew);
  c.refuted = !test.somethingGrows();
  return parts;
}

/// Without ordering one look is enough.
bool confirms(const State& state) { return state.settings.unmerging.ordering; }

void noteFooting(const Collection& c, const Footing& footing, Notes* notes) {
  if (!notes) return;
  for (const std::uint32_t w : footing.giving) {
    notes->decisions.push_back({.a = c.welds[w].a,
                                .b = c.welds[w].b,
                                .stage = "Unmerge",
                                .criterion = "footing",
                                .equation = kOwnUnmerging,
                                .value = footing.speed,
                                .threshold = footing.enough,
                                .count = 1,
                                .verdict = "unmerge"});
  }
}

/// Splits a collection whose model of a few rigid parts is not in equilibrium.
bool losesFooting(State& state, Scratch& scratch, Tested& tested) {
  Collection& c = state.collections[tested.slot];
  const Footing footing = footingOf(state, scratch, c);
  if (footing.giving.empty()) return false;
  for (const std::uint32_t w : footing.giving) c.welds[w].cut = true;
  Parts parts = judge(state, scratch, c);
  if (!fallsApart(state, c, parts)) {
    for (const std::uint32_t w : footing.giving) c.welds[w].cut = false;
    return false;
  }
  for (const std::uint32_t w : footing.giving) {
    c.welds[w].reason = EventReason::RelativeMotion;
    c.welds[w].turning = {static_cast<float>(footing.speed), 1};
  }
  c.cut_welds = footing.giving;
  noteFooting(c, footing, scratch.notes);
  tested.noted.close();
  tested.fallsInto(std::move(parts));
  tested.sure = std::ranges::none_of(
      footing.giving, [&](std::uint32_t w) { return cautionWith(state, c, c.welds[w]) > 1.0; });
  return true;
}

/// Tests the welds of one collection, and finds the parts that it falls into.
void testCollection(State& state, Scratch& scratch, Tested& tested) {
  const std::size_t slot = tested.slot;
  Collection& c = state.collections[slot];
  scratch.doubted.clear();
  for (const std::uint32_t weld : c.cut_welds) c.welds[weld].cut = false;
  c.cut_welds.clear();
  if (anyJointBreaks(state, c) && breakInside(state, scratch, c)) return;
  if (confirms(state) && losesFooting(state, scratch, tested)) return;
  const bool joints_loosened = loosenJoints(state, c, scratch.sweep_u);
  if (joints_loosened) doubtJoints(scratch, c);
  WeldTest test(state, scratch, c, scratch.disturbed[slot] != 0);
  test.testAll();
  if (confirms(state) && !joints_loosened &&
      waits(state, c, scratch.disturbed[slot] != 0, tested.noted))
    return;
  if (joints_loosened) c.stood.clear();
  listOthers(state, scratch, c);
  const bool loses_a_member = losesAMember(c, scratch);
  std::optional<Parts> parts;
  if (!confirms(state) || !loses_a_member) {
    parts = partsAtCuts(state, scratch, c, joints_loosened || loses_a_member);
    if (!parts) return forgetRefusals(state, c);
  }
  if (confirms(state)) {
    parts = confirmedParts(state, scratch, c, test, joints_loosened, tested.noted);
  }
  if (parts) tested.fallsInto(*std::move(parts));
}

/// Asks the trial about all collections at once, and keeps the parts that would not move.
void keepWhatStays(State& state, Scratch& scratch, std::vector<Tested>& apart) {
  if (apart.empty()) return;
  std::vector<Proposal> proposals;
  for (const Tested& t : apart) {
    proposals.push_back({state.collections[t.slot].rigid, t.parts, t.sure});
  }
  auto remaining = partsThatMove(state, scratch, proposals);
  for (std::size_t i = 0; i < apart.size(); ++i) {
    Collection& c = state.collections[apart[i].slot];
    apart[i].apart = remaining[i] && fallsApart(state, c, *remaining[i]);
    if (remaining[i]) {
      apart[i].parts = *std::move(remaining[i]);
    } else {
      restate(state, apart[i].noted, "stays");
      refuse(c);
    }
  }
}

}  // namespace

void unmergeConfirmed(State& state, Scratch& scratch) {
  std::vector<Tested> apart;
  const std::size_t slots = state.collections.size();
  for (std::size_t slot = 0; slot < slots; ++slot) {
    if (!isSwept(state, state.collections[slot])) continue;
    Tested tested{slot, Noted(scratch.notes)};
    testCollection(state, scratch, tested);
    tested.noted.close();
    if (!tested.apart) restate(state, tested.noted, "cut");  // but held together by others
    if (tested.apart) apart.push_back(std::move(tested));
  }
  if (confirms(state)) keepWhatStays(state, scratch, apart);
  for (const Tested& tested : apart) {
    const RigidId id = state.collections[tested.slot].rigid;
    if (tested.apart) splitAtCuts(state, scratch, id, tested.parts);
    restate(state, tested.noted, "cut");
  }
}

}  // namespace merge2d
