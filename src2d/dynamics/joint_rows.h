#pragma once
/// The joints in the full solve: they stand in the islands and sweeps of the contacts.

#include <span>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Lists the joints that act in the full solve, and unites the islands that they connect.
void uniteJoints(const State& state, Scratch& scratch);

/// A light link between joints that pull hard turns to and fro faster than steps can follow: with
/// stiffness k = Σ r·f about its centre of mass, at ω = √(k/I). From ω h = 2 on it would gain
/// energy in each step, so its inertia in this solve is at least k h², as a finite element's that
/// limits the step; a rod's ends get a mass likewise. That is little beside the masses that pull so
/// hard. See Andrews, Teichmann, Kry, "Geometric Stiffness for Real-time Constrained Multibody
/// Dynamics" (2017), which adds a damping instead. To be called before forces act on velocities.
void slowTautLinks(const State& state, Scratch& scratch);

/// Builds their rows by island, and the islands that have no contacts.
void buildJointBlocks(State& state, Scratch& scratch);

/// The impulses of the last step, on the velocities.
void warmStartJoints(std::span<const JointBlock> joints, std::vector<SolverVelocity>& u);

/// Bodies go straight ahead for a step, and joints would stretch by how much their paths bend: in
/// a circle at 5 m/s and 5 m by 0.25 mm in a step of 0.01 s, and again in the next one. Adds to the
/// rows a bias that takes that back already in this step, which also keeps the energy of swinging
/// bodies (as SHAKE does: Ryckaert, Ciccotti, Berendsen 1977). `bends` is the bias that the rows
/// have already, per joint. False when there is nothing to add.
bool allowForBends(const State& state, std::span<JointBlock> joints,
                   const std::vector<SolverVelocity>& u, std::vector<JointErrors>& bends);

void rememberMotion(std::span<const JointBlock> joints, const std::vector<SolverVelocity>& u,
                    std::vector<JointMotion>& motion);

/// True when the change of the velocities since `before` is a correction: its own bend, of second
/// order, is no larger than the errors of `corrected` [m] at most that it takes back. A straight
/// chain between two fixed ends has no room for one: the smallest error asks for a fast motion
/// across, which makes a larger one, and adds energy in each step.
bool correctionHolds(const State& state, std::span<const JointBlock> joints,
                     const std::vector<SolverVelocity>& u, const std::vector<JointMotion>& before,
                     double corrected);

/// Hands the impulses back to the joints.
void storeJointImpulses(State& state, const Scratch& scratch);

/// Breaks the joints that bear too much, after the last solve of a step.
void breakOverloadedJoints(State& state, Scratch& scratch);

}  // namespace merge2d
