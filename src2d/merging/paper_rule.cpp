#include "src2d/merging/paper_rule.h"

#include "src2d/collections/collection.h"
#include "src2d/collections/inner_push.h"
#include "src2d/dynamics/solver.h"
#include "src2d/merging/ordering.h"
#include "src2d/merging/sweep.h"
#include "src2d/merging/warm_start.h"
#include "src2d/sleeping/sleep.h"

namespace merge2d {
namespace {

/// Section 5: relative motion, sliding and breathing.
constexpr PairCriterion kPaperCriteria[] = {slidesSlowly, hardlyBreathes, movesAsOne};

/// Section 8.2 is future work.
CycleCriterion noCycles(const MergingSettings&) { return CycleCriterion::Off; }

/// The rows of the full solve, with compliance and feedback (Section 5.3).
InnerRows softRows(const State& state, const InternalContact& contact, const SolverVelocity& a,
                   const SolverVelocity& b) {
  const SolverSettings& settings = state.settings.solver;
  const ContactKey& key = contact.key;
  const bool bilateral = isBilateral(state, key.a, key.b);
  InnerRows rows{.softness = contactSoftness(state, key.a, key.b, a.inv_mass, b.inv_mass)};
  for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i) {
    rows.bias[i] = bilateral ? bilateralBias(settings, state.h, contact.gap[i], 0.0)
                             : contactBias(settings, state.h, contact.gap[i]);
  }
  return rows;
}

/// "If a contact is inactive when two bodies are merged, we discard it from the contact graph"
/// (Section 6.3). Where no contact of a pair carries anything they stay, unswept, so that the pair
/// is known.
void discardInactive(InternalContact& contact) {
  if (contact.count < 2 || contact.watch[0].active == contact.watch[1].active) return;
  if (!contact.watch[0].active) {
    contact.watch[0] = contact.watch[1];
    contact.points[0] = contact.points[1];
    contact.gap[0] = contact.gap[1];
    contact.feature[0] = contact.feature[1];
  }
  contact.watch[1] = {};
  contact.count = 1;
}

int waitsNever(const State&, const Weld*) { return 0; }

/// The contacts around collections, then those inside. A contact that carried nothing when its pair
/// merged is no part of the contact graph: its block is not among the active ones.
std::vector<SweepItem> sweepItems(State& state, Scratch& scratch) {
  std::vector<SweepItem> items;
  for (SweepContact& outer : scratch.sweep_contacts) items.emplace_back(outer.block);
  for (JointBlock& k : scratch.sweep_joints) items.emplace_back(k);
  const auto inside = [&](auto&& list) {
    for (Collection& c : state.collections) {
      if (isSwept(state, c)) list(c, state[c.rigid].rotation);
    }
  };
  inside([&](Collection& c, const Rotation& turn) {
    for (JointBlock& k : c.joints) items.emplace_back(k, turn);
  });
  inside([&](Collection& c, const Rotation& turn) {
    for (std::uint32_t i = 0; i < c.blocks.size(); ++i) {
      const bool expected = c.contacts[c.block_contact[i]].since == kExpected;
      if (i < c.laid_out.active_blocks || expected) items.emplace_back(c.blocks[i], turn);
    }
  });
  return items;
}

void sweepByOrder(State& state, Scratch& scratch) {
  sweepAround(state, scratch, sweepBreadthFirst);
}

}  // namespace

constinit const MergingMethod kPaperMerging{
    .criteria = kPaperCriteria,
    .cycles = noCycles,
    .weld = weldPairsAndFloors,
    .uniteParts = uniteOnFloors,
};

constinit const UnmergingMethod kPaperUnmerging{
    .sleepAndWake = sleepEachByItself,
    .warmStart = warmStartSweep,
    .sweep = sweepByOrder,
    .unmerge = unmergeByContacts,
    .collections = {.enter = discardInactive,
                    .innerRows = softRows,
                    .parts = connectedParts,
                    .waitAfterSplit = waitsNever},
};

void sweepBreadthFirst(State& state, Scratch& scratch) {
  const auto& settings = state.settings;
  std::vector<SweepItem> items = sweepItems(state, scratch);
  if (!scratch.seeds.empty()) items = orderedFromSeeds(items, scratch);
  for (int s = 0; s < settings.unmerging.sweeps; ++s) {
    for (const SweepItem& item : items) sweepItem(item, scratch.sweep_u, settings.solver.method);
  }
  for (Collection& c : state.collections) {
    if (!isSwept(state, c)) continue;
    c.push.forget();
    layOutPush(state, c);
  }
}

}  // namespace merge2d
