#pragma once
/// The part of a rule's table (merging/rule.h) that joining, layout and splitting of collections
/// ask.

#include "src2d/collections/parts.h"
#include "src2d/dynamics/state.h"

namespace merge2d {

/// The part of a contact's rows inside a collection that the rules differ about.
struct InnerRows {
  double softness = 0.0;         ///< [1/kg]
  std::array<double, 2> bias{};  ///< per point [m/s]
};

/// How collections take contacts in, keep them and let them go.
struct CollectionMethod {
  /// Merge: a contact enters a collection.
  void (*enter)(InternalContact& contact);
  /// The rows of a contact inside a collection; the masses are those of its two bodies.
  InnerRows (*innerRows)(const State& state, const InternalContact& contact,
                         const SolverVelocity& a, const SolverVelocity& b);
  /// The parts that the welds hold together that are not cut.
  Parts (*parts)(const State& state, const Collection& collection);
  /// How many steps a contact waits that leaves its collection, before its pair may merge again.
  /// `cut` is its weld when a test of this step cut it, else null.
  int (*waitAfterSplit)(const State& state, const Weld* cut);
};

/// That of the rule in force. Defined above this room, in merging/rule_selection.cpp: a pointer in
/// the state would have to follow each edit and each saved state, and a parameter would pass
/// through every caller of a merge, a layout or a split.
const CollectionMethod& collectionMethod(const State& state);

}  // namespace merge2d
