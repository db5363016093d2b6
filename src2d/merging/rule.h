#pragma once
/// The rules of merging and unmerging (Sections 5 to 7) as tables of functions: one table for each
/// value of `merging.rule` and of `unmerging.rule`. The stages of a step and the parts that all
/// rules share (collections, splits, rows) ask the table; no other code knows which rule is in
/// force.

#include <span>

#include "src2d/collections/collection_method.h"
#include "src2d/dynamics/state.h"
#include "src2d/merging/merge_criteria.h"

namespace merge2d {

/// Which pairs merge (Section 5).
struct MergingMethod {
  /// A pair is ready in a step in which all of these hold; the expensive ones come last.
  std::span<const PairCriterion> criteria;
  /// The criterion for pairs with single contacts that are ready (Section 8.2).
  CycleCriterion (*cycles)(const MergingSettings& settings);
  /// Welds pairs: makes their bodies one.
  void (*weld)(State& state, Scratch& scratch, const std::vector<BodyPair>& pairs);
  /// Parts of a collection that its welds do not join, but that are one all the same.
  void (*uniteParts)(const Collection& collection, PartFinder& finder);
};

/// How the forces inside collections are kept, and which bodies come free (Sections 6 and 7).
struct UnmergingMethod {
  /// SleepAndWake.
  void (*sleepAndWake)(State& state, Scratch& scratch);

  /// WarmStart. Sets `scratch.sweeping` where SingleIterationPGS and Unmerge have something to do.
  void (*warmStart)(State& state, Scratch& scratch);

  /// SingleIterationPGS: updates the impulses inside collections. Called where some collection is
  /// awake.
  void (*sweep)(State& state, Scratch& scratch);

  /// Unmerge: cuts welds, and splits the collections that fall apart (cuts.h).
  void (*unmerge)(State& state, Scratch& scratch);

  /// Joining, layout and splitting of collections.
  CollectionMethod collections;
};

/// The tables that the settings name: the one place where a rule is chosen (rule_selection.cpp).
const MergingMethod& mergingMethod(const State& state);
const UnmergingMethod& unmergingMethod(const State& state);

}  // namespace merge2d
