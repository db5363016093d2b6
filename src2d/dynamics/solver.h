#pragma once
/// SolveLCP: the contact forces of everything in B, Eqs. (2)-(9).
///
/// Default: block sweeps inside a nonsmooth nonlinear conjugate gradient (Silcowitz-Hansen, Niebe,
/// Erleben 2010), per island. Deviation: the paper runs plain PGS; at ten sweeps it holds neither
/// tall columns nor walls (docs/decisions/solver.md). "pgs" selects it.
/// Guarded by tests/src2d/dynamics/solver_test.cpp.

#include <span>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The velocity [m/s] with which a gap is to be closed at most, or an overlap removed, at a contact
/// with `gap` [m].
double contactBias(const SolverSettings& settings, double h, double gap);

/// The same for a magnet's contact, which shall have just this velocity. A gap is closed at the
/// speed `closing` [m/s] with which it closes already, but no slower than an overlap is removed,
/// and no faster than the gap allows: a magnet neither takes hold with a blow, nor stops a body
/// that has not reached it. Guarded by Magnet.TakesHoldWithoutABlow and
/// Magnet.AddsNoEnergyToWhatSpinsPast.
double bilateralBias(const SolverSettings& settings, double h, double gap, double closing);

/// The smaller side of the smaller of two bodies, of those that respond to forces [m].
double contactSize(const State& state, BodyId a, BodyId b);

/// The softness C [1/kg] of the contacts of two bodies with these masses (scene/compliance.h).
/// Guarded by Sizes.StacksOfAnySizeStandAsHighAsTheyAre.
double contactSoftness(const State& state, BodyId a, BodyId b, double inv_mass_a,
                       double inv_mass_b);

/// SolveLCP, unless the step has been solved before; then joints break.
void solveContacts(State& state, Scratch& scratch);

/// Sweeps over the rows; writes the impulses into contacts and joints, and the velocities into
/// `scratch.u`.
void solveAllRows(State& state, Scratch& scratch);

}  // namespace merge2d
