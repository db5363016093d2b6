#pragma once
/// All joints of a collection solved at once.

#include <vector>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Solves the rows of all joints inside a collection together, where one joint after the other
/// leaves more than `enough` [m/s] of motion in them: in a chain each sweep carries a moment on by
/// one joint only, and then changes so little that it seems to be done long before it is.
/// `turn` brings the collection's frame into that of the velocities.
/// Motors and limits take part while they are inside their bounds. Deviation: beside the single
/// sweep of Section 6.2. Guarded by JointSystem.ACantileverBreaksWhereStaticsSay.
void settleJoints(Collection& collection, const Rotation& turn, std::vector<SolverVelocity>& u,
                  double enough);

}  // namespace merge2d
