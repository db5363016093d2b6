#pragma once
/// The pairs whose bodies joints alone hold together: for how many steps they could have merged.

#include <vector>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Counts the steps in which the bodies of each joint could have merged: Eqs. (15)-(17), and the
/// joint must have come to rest.
void countQuietJoints(State& state, Scratch& scratch);

/// A pair of bodies that joints alone hold together, as so many contacts would.
struct JointEdge {
  BodyId a{}, b{};
  int freedoms = 0;        ///< those that the joints take away
  int contacts = 0;        ///< 0: they hold nothing
  Vec2 at = Vec2::Zero();  ///< in the world [m]
};

/// The pairs whose joints were quiet for `merging.steps` steps, ascending.
std::vector<JointEdge> pairsOfQuietJoints(const State& state);

}  // namespace merge2d
