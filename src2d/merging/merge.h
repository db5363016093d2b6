#pragma once
/// AccumulateRelativeMotion and Merge (Section 5).
///
/// Deviation under `merging.rule = "default"`: a pair with a contact on the edge of its friction
/// cone is not ready (it is about to slide), and a pair with a single contact is welded only as
/// part of a rigid group. Guarded by tests/src2d/merging/merge_test.cpp.

#include <algorithm>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The factor on the thresholds for bodies of a size [m]: a hundredth of a metre per second is
/// little for a brick, and a hundred times its size per second for a grain of 0.1 mm.
inline double thresholdScale(double size) {
  constexpr double kUsual = 0.1;  // [m]
  return std::min(1.0, size / kUsual);
}

/// Eq. (15); only the boxes of floating things are looked at [m/s]. With `merging.metric = "naive"`
/// only the contacts of a pair are.
double relativeMotion(const State& state, const BodyPair& pair, Notes* notes);

/// Counts, for each pair in contact, the consecutive steps in which it could merge: relative
/// motion, Eqs. (15)-(17); sliding, Eq. (18); breathing; and for sleep each rigid thing's own
/// motion.
void accumulateRelativeMotion(State& state, Scratch& scratch);

/// Welds the pairs that were ready for `merging.steps` steps.
void merge(State& state, Scratch& scratch);

/// The full solve has become smaller: its memory goes back.
void releaseRows(State& state, Scratch& scratch);

}  // namespace merge2d
