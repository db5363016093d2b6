#include "src2d/merging/default_rule.h"

#include <algorithm>

#include "src2d/dynamics/solver.h"
#include "src2d/merging/default_unmerge.h"
#include "src2d/merging/refined_sweep.h"
#include "src2d/merging/sleep.h"
#include "src2d/merging/spare_welds.h"
#include "src2d/merging/sweep.h"
#include "src2d/merging/warm_start.h"

namespace merge2d {
namespace {

CycleCriterion asSet(const MergingSettings& settings) { return settings.cycles; }

/// Deviation from the start with today's velocity, which would miss the force that keeps a member
/// on its circle: the orientation before the last position update.
/// Guarded by Sweep.HoldsASpinningMemberOnItsCircle.
Rotation beforeLastUpdate(const Rigid& collection) { return collection.previous_rotation; }

/// Deviation: contacts inside a collection are rigid rows, without bias and softness: their overlap
/// is frozen, and would ask for a ghost velocity whenever the load changes. The bias of a point
/// that may not have met yet stays. Guarded by Sweep.HoldsAColumnsWeightExactly.
InnerRows rigidRows(const State& state, const InternalContact& contact, const SolverVelocity&,
                    const SolverVelocity&) {
  const bool bilateral = isBilateral(state, contact.key.a, contact.key.b);
  InnerRows rows;
  for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i) {
    if (contact.watch[i].active || contact.gap[i] <= 0.0) continue;
    rows.bias[i] = contactBias(state.settings.solver, state.h, contact.gap[i], bilateral);
  }
  return rows;
}

/// Deviation: a point that carries nothing when its pair merges is kept, as it may be needed later.
/// Guarded by Cures.AContactThatCarriedNothingWhenItsPairMergedTakesALoadLater.
void keepAllPoints(InternalContact&) {}

/// The number of steps for which a pair that turns as slowly as this seems to be at rest.
int stepsUntilSeen(const State& state, const Drift& turning) {
  constexpr double kMost = 200.0;  // steps
  const double seen = state.settings.merging.velocity * turning.steps;
  const double sum = std::abs(turning.sum);
  return std::max(turning.steps, static_cast<int>(std::min(seen / std::max(sum, 1e-12), kMost)));
}

/// Deviation: a weld that broke soon after it had formed waits for the rest of this time before its
/// contacts are looked at again, or the pair would merge and part in turn while it barely moves.
/// Guarded by Unmerge.AWeldThatBrokeAtOnceDoesNotFormAtOnce. And one that turned slowly waits for
/// as long as it would still seem at rest. Guarded by
/// Seesaw.BarelyOutOfBalanceTipsAsInTheReference.
int waitAfterFlicker(const State& state, const InternalContact& inner, const Weld* cut) {
  constexpr std::int64_t kFlicker = 20;  // steps
  const auto rest =
      static_cast<int>(std::max(std::int64_t{0}, kFlicker - (state.step - inner.since)));
  const bool turned = cut && cut->reason == EventReason::RelativeMotion;
  return turned ? std::max(rest, stepsUntilSeen(state, cut->turning)) : rest;
}

void sweepAll(State& state, Scratch& scratch) { sweepAround(state, scratch, sweepRefined); }

}  // namespace

constinit const MergingMethod kDefaultMerging{
    .refuses_edge = true,
    .unites_on_floors = false,
    .cycles = asSet,
};

constinit const UnmergingMethod kDefaultUnmerging{
    .sleepAndWake = sleepByIslands,
    .warmStart = warmStartSweep,
    .startingRotation = beforeLastUpdate,
    .sweeps_free_bodies = false,
    .sweep = sweepAll,
    .unmerge = unmergeConfirmed,
    .parts = judge,
    .waitAfterSplit = waitAfterFlicker,
    .innerRows = rigidRows,
    .enter = keepAllPoints,
};

}  // namespace merge2d
