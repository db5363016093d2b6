#pragma once
/// The joints in the full solve: they stand in the islands and sweeps of the contacts.

#include <span>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Lists the joints that act in the full solve, and unites the islands that they connect.
void uniteJoints(const State& state, Scratch& scratch);

/// Builds their rows by island, and the islands that have no contacts.
void buildJointBlocks(State& state, Scratch& scratch);

/// The impulses of the last step, on the velocities.
void warmStartJoints(std::span<const JointBlock> joints, std::vector<SolverVelocity>& u);

/// Solves every joint once.
void sweepJoints(std::span<JointBlock> joints, std::vector<SolverVelocity>& u);

/// Hands the impulses back to the joints, and breaks those that bear too much.
void storeJointImpulses(State& state, Scratch& scratch);

}  // namespace merge2d
