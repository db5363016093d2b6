#include "src2d/merging/default_rule.h"

#include <algorithm>

#include "src2d/dynamics/solver.h"
#include "src2d/dynamics/thread_memory.h"
#include "src2d/merging/decided_unmerge.h"
#include "src2d/merging/doubt.h"
#include "src2d/merging/doubt_spread.h"
#include "src2d/merging/merge.h"
#include "src2d/relaxation/open_solve.h"
#include "src2d/relaxation/proof_search.h"
#include "src2d/sleeping/sleep.h"

namespace merge2d {
namespace {

/// Deviation: a pair that is about to slide, or whose load still changes, is not ready. Guarded by
/// Merge.APairOnTheEdgeOfItsConeWaits and Merge.APairWaitsUntilItsImpulseHasSettled.
constexpr PairCriterion kMergeCriteria[] = {slidesSlowly, hardlyBreathes, isNotAboutToSlide,
                                            hasSettledLoad, movesAsOne};

void uniteNone(const Collection&, PartFinder&) {}

CycleCriterion asSet(const MergingSettings& settings) { return settings.cycles; }

void countStep(ProofSearch& search) {
  constexpr std::int16_t kMost = (1 << 14) + 1;  // no power of two, as these stand for an event
  if (search.steps < kMost) ++search.steps;
}

/// Goes on with the search inside a collection.
void goOnWithSearch(State& state, Scratch& scratch, const SweepTools& sweeps, Collection& c) {
  const SearchTools tools = searchToolsOf(scratch, sweeps, c);
  continueSearch(state, tools, c, toleratedResidual(state));
  countStep(c.certificate.front().search);
  if (endSearch(state, tools, c)) return;
  scratch.doubts[state.collections.slotOf(c)] = Doubt::Open;
}

/// The slots of the collections in which something is sought.
std::vector<std::uint32_t> searchedSlots(const State& state, const Scratch& scratch) {
  std::vector<std::uint32_t> slots;
  for (const Collection& c : state.collections) {
    if (doubtAbout(state, scratch, c) != Doubt::Search) continue;
    slots.push_back(static_cast<std::uint32_t>(state.collections.slotOf(c)));
  }
  return slots;
}

/// The searches know nothing of each other, and go on side by side. Where the large collections are
/// fewer than the threads, all share the sweeps of each of them instead. Records have an order.
void goOnWithSearches(State& state, Scratch& scratch) {
  std::vector<std::uint32_t> slots = searchedSlots(state, scratch);
  for (const std::uint32_t slot : slots) makeRoom(state, scratch, state.collections[slot]);
  provideMemory(scratch);
  const auto isBig = [&](std::uint32_t slot) { return isLarge(state, state.collections[slot]); };
  const bool shares = std::ranges::count_if(slots, isBig) < threadsOf(scratch);
  const auto in_turn = std::stable_partition(slots.begin(), slots.end(), [&](std::uint32_t slot) {
    return !scratch.notes && !(shares && isBig(slot));
  });
  const auto beside = static_cast<std::size_t>(in_turn - slots.begin());
  forEachIndex(scratch.tasks, beside, 1, [&](std::size_t i, int thread) {
    goOnWithSearch(state, scratch, toolsOf(scratch, thread), state.collections[slots[i]]);
  });
  for (std::size_t i = beside; i < slots.size(); ++i) {
    goOnWithSearch(state, scratch, ownTools(scratch), state.collections[slots[i]]);
  }
}

/// Where a search has found motion, the full solve of the same step finds the moving welds.
void solveDoubted(State& state, Scratch& scratch) {
  goOnWithSearches(state, scratch);
  askJoined(state, scratch);
  const auto asksTheSolve = [&](const Collection& c) {
    const Doubt doubt = doubtAbout(state, scratch, c);
    return doubt == Doubt::Open || doubt == Doubt::Reached;
  };
  if (std::ranges::any_of(state.collections, asksTheSolve)) solveOpened(state, scratch);
}

/// Deviation: contacts inside a collection are rigid rows, without bias and softness: their overlap
/// is frozen, and would ask for a ghost velocity whenever the load changes. The bias of a point
/// that may not have met yet stays. Guarded by Sweep.HoldsAColumnsWeight.
InnerRows rigidRows(const State& state, const InternalContact& contact, const SolverVelocity&,
                    const SolverVelocity&) {
  const bool bilateral = isBilateral(state, contact.key.a, contact.key.b);
  InnerRows rows;
  for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i) {
    if (contact.watch[i].active || contact.gap[i] <= 0.0) continue;
    const SolverSettings& settings = state.settings.solver;
    rows.bias[i] = bilateral ? bilateralBias(settings, state.h, contact.gap[i], 0.0)
                             : contactBias(settings, state.h, contact.gap[i]);
  }
  return rows;
}

/// Deviation: a point that carries nothing when its pair merges is kept, as it may be needed later.
/// Guarded by Cures.AContactThatCarriedNothingWhenItsPairMergedTakesALoadLater.
void keepAllPoints(InternalContact&) {}

Parts uncutParts(const State&, const Collection& c) { return componentsOf(c); }

/// Deviation: a pair that parted slowly waits for as long as it would still seem at rest. Guarded
/// by Seesaw.BarelyOutOfBalanceTipsAsInTheReference.
int waitUntilSeen(const State& state, const Weld* cut) {
  if (!cut || cut->motion <= 0.0F) return 0;
  return static_cast<int>(stepsUntilSeen(state, static_cast<double>(cut->motion)));
}

}  // namespace

constinit const MergingMethod kDefaultMerging{
    .criteria = kMergeCriteria,
    .cycles = asSet,
    .weld = weldPairs,
    .uniteParts = uniteNone,
};

constinit const UnmergingMethod kDefaultUnmerging{
    .sleepAndWake = sleepByIslands,
    .warmStart = findDoubts,
    .sweep = solveDoubted,
    .unmerge = unmergeMovers,
    .collections = {.enter = keepAllPoints,
                    .innerRows = rigidRows,
                    .parts = uncutParts,
                    .waitAfterSplit = waitUntilSeen},
};

}  // namespace merge2d
