#pragma once
/// The rules of merging and unmerging (Sections 5 to 7) as tables of functions: one table for each
/// value of `merging.rule` and of `unmerging.rule`. The stages of a step and the parts that all
/// rules share (collections, splits, rows) ask the table; no other code knows which rule is in
/// force.

#include "src2d/dynamics/state.h"
#include "src2d/merging/parts.h"

namespace merge2d {

/// Which pairs merge (Section 5).
struct MergingMethod {
  /// A pair all of whose contacts are on the edge of their cones, Eq. (20), is not ready.
  bool refuses_edge;
  /// Collections on one pinned or scripted body are one collection.
  bool unites_on_floors;
  /// The criterion for pairs with single contacts that are ready (Section 8.2).
  CycleCriterion (*cycles)(const MergingSettings& settings);
};

/// The part of a contact's rows inside a collection that the rules differ about.
struct InnerRows {
  double softness = 0.0;         ///< [1/kg]
  std::array<double, 2> bias{};  ///< per point [m/s]
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
  /// The parts that the welds hold together that are not cut.
  Parts (*parts)(const State& state, Scratch& scratch, const Collection& collection);
  /// How many steps a contact waits that leaves its collection, before its pair may merge again.
  /// `cut` is its weld when a test of this step cut it, else null.
  int (*waitAfterSplit)(const State& state, const InternalContact& contact, const Weld* cut);

  /// The rows of a contact inside a collection; the masses are those of its two bodies.
  InnerRows (*innerRows)(const State& state, const InternalContact& contact,
                         const SolverVelocity& a, const SolverVelocity& b);
  /// Merge: a contact enters a collection.
  void (*enter)(InternalContact& contact);
};

/// The tables that the settings name: the one place where a rule is chosen (rule_selection.cpp).
const MergingMethod& mergingMethod(const State& state);
const UnmergingMethod& unmergingMethod(const State& state);

}  // namespace merge2d
