#pragma once
/// The joints inside a collection as welds, counted in contacts. A revolute joint is a pivot, as a
/// single contact is, and holds only in a rigid group or beside another contact or joint; a weld
/// joint counts as two contacts and holds alone; so do a strong enough brake and a limit that
/// presses.

#include <span>
#include <vector>

#include "src2d/dynamics/state.h"

namespace merge2d {

inline constexpr int kFreedoms = 3;  ///< of one body against another

/// The relative freedoms that the joints of one pair take away.
struct JointHold {
  int freedoms = 0;
  bool pivot = false;  ///< some point is shared

  void add(JointKind kind, int taken) {
    freedoms += taken;
    pivot |= kind == JointKind::Revolute;
  }
  /// Counted in contacts: a pivot takes two of the three relative freedoms, two contacts take all.
  int contacts() const {
    if (freedoms >= kFreedoms) return 2;
    return freedoms == 2 && pivot ? 1 : 0;
  }
};

/// Adds a weld for each pair of bodies that has joints inside the collection, with the contacts
/// that these count as just now. Welds stay ascending.
void addJointWelds(const State& state, Collection& collection);

/// After a sweep with the velocities `u`: counts the joints of each weld anew. A limit lets go, and
/// a brake or a soft joint yields, once the velocities that the sweep finds there sum up to
/// `unmerging.sliding`. True when some weld holds less.
bool loosenJoints(State& state, Collection& collection, const std::vector<SolverVelocity>& u);

/// The fastest motion with which a soft joint inside would give way further under the impulses that
/// stand there, of the corners of its bodies [m/s].
double fastestYield(const State& state, const Collection& collection);

/// True when a joint inside bears more than it can.
bool anyJointBreaks(const State& state, const Collection& collection);

/// Takes these joints out of the collection, which is to be laid out anew.
std::vector<std::uint32_t> takeOverloadedJoints(const State& state, Collection& collection);

/// Breaks those of them whose bodies other things still hold together. Between bodies that came
/// apart a joint acts once more, in this step's full solve unless that is over, and breaks then, as
/// without merging; otherwise the blow that breaks it would not slow the bodies that it held.
void breakWhatStaysInside(State& state, Scratch& scratch, std::span<const std::uint32_t> joints);

}  // namespace merge2d
