#pragma once
/// The joints inside a collection as welds, counted in contacts. A revolute joint is a pivot, as a
/// single contact is, and holds only in a rigid group or beside another contact or joint; a weld
/// joint counts as two contacts and holds alone; so do a strong enough brake and a limit that
/// presses.

#include <span>

#include "src2d/cycles/held_groups.h"
#include "src2d/dynamics/state.h"

namespace merge2d {

/// Adds a weld for each pair of bodies that has joints inside the collection, with the contacts
/// that these count as just now. Welds stay ascending.
void addJointWelds(const State& state, Collection& collection);

/// After a sweep with the velocities `u`: counts the joints of each weld anew. A limit lets go, and
/// a brake yields, once the velocities that the sweep finds there sum up to `unmerging.sliding`.
/// True when some weld holds less.
bool loosenJoints(State& state, Collection& collection, const std::vector<SolverVelocity>& u);

/// True when a joint inside bears more than it can.
bool anyJointBreaks(const State& state, const Collection& collection);

/// Takes these joints out of the collection, which is to be laid out anew.
std::vector<std::uint32_t> takeOverloadedJoints(const State& state, Collection& collection);

/// Breaks those of them whose bodies other things still hold together. Between bodies that came
/// apart a joint acts once more, in this step's full solve unless that is over, and breaks then, as
/// without merging; otherwise the blow that breaks it would not slow the bodies that it held.
void breakWhatStaysInside(State& state, Scratch& scratch, std::span<const std::uint32_t> joints);

/// Counts the steps in which the bodies of each joint could have merged: Eqs. (15)-(17), and the
/// joint must have come to rest.
void countQuietJoints(State& state, Scratch& scratch);

inline constexpr int kFreedoms = 3;  ///< of one body against another

/// A pair of bodies that joints alone hold together, as so many contacts would.
struct JointEdge {
  BodyId a{}, b{};
  int freedoms = 0;        ///< those that the joints take away
  int contacts = 0;        ///< 0: they hold nothing
  Vec2 at = Vec2::Zero();  ///< in the world [m]
};

/// The pairs whose joints were quiet for `merging.steps` steps, ascending.
std::vector<JointEdge> readyJoints(const State& state);

}  // namespace merge2d
