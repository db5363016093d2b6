#pragma once
/// SolveLCP by Newton's method: `solver.method = "newton"`, for heavy ratios.
///
/// The velocities minimise ½|u − u*|²_M where no admissible impulse (Eqs. (5)-(7)) could act
/// against them: a convex problem (Anitescu 2006), whose multipliers are the impulses. A cone of
/// friction has two edges in the plane, n ± μ t, with an impulse x ≥ 0 along each and a slack s ≥
/// 0, the velocity along it; x s = 0. A primal-dual interior point method keeps all products x s
/// alike and drives them to zero (Mehrotra 1992): some twenty factorisations of M + Jᵀ G J, however
/// tall a stack is and however much masses differ. All rows of an island are solved at once. In
/// that minimum a contact that slides at w_t opens at μ w_t: sweeps follow, which undo it.

#include <span>
#include <vector>

#include "src2d/dynamics/collections.h"
#include "src2d/dynamics/contact_block.h"
#include "src2d/dynamics/joint_block.h"
#include "src2d/dynamics/newton_workspace.h"

namespace merge2d {

/// Solves the rows of an island from the impulses that they have. `u` holds the velocities of its
/// `bodies` before any of these impulses [m/s], and then those after all of them. False where it
/// has not converged, as a factorisation was lost to rounding: nothing is changed then, and sweeps
/// must do.
bool solveByNewton(std::span<ContactBlock> blocks, std::span<JointBlock> joints,
                   std::span<const std::uint32_t> bodies, std::vector<SolverVelocity>& u);

/// The same in parts, of at most so many steps each, with the same blocks, joints and velocities:
/// false where the solve goes on, and has changed nothing but the iterate. Rows may miss their
/// velocities by `tolerance` afterwards [m/s]; by more where it has not converged. The workspace is
/// that of the part before, or empty.
bool continueByNewton(std::span<ContactBlock> blocks, std::span<JointBlock> joints,
                      std::span<const std::uint32_t> bodies, std::vector<SolverVelocity>& u,
                      double tolerance, NewtonIterate& iterate, int most_steps,
                      NewtonWorkspace& workspace);

}  // namespace merge2d
