#pragma once
/// SolveLCP by Newton's method: `solver.method = "newton"`, for heavy ratios.
///
/// Source: Castro, Permenter, Han, "An Unconstrained Convex Formulation of Compliant Contact"
/// (2022). The velocities minimise ½|u − u*|²_M + Σ φ(w): φ is the convex function whose slope is
/// the impulse γ, and γ the projection of −C⁻¹(w + bias), in the metric of C, on the impulses that
/// are admissible (Eqs. (5)-(7)). All rows of an island are solved at once, so that mass ratios and
/// tall stacks do not matter. In that minimum a contact that slides at w_t opens at μ w_t: sweeps
/// follow, which undo it.
///
/// C is the softness of a row. Rigid rows are taken to be softer, and friction as soft as its
/// normal, or the function has kinks at which Newton's steps become short; they are held to the
/// impulses found before, in a few rounds (the method of multipliers).

#include <span>
#include <vector>

#include "src2d/dynamics/collections.h"
#include "src2d/dynamics/contact_block.h"
#include "src2d/dynamics/joint_block.h"

namespace merge2d {

/// Solves the rows of an island from the impulses that they have. `u` holds the velocities of its
/// `bodies` before any of these impulses [m/s], and then those after all of them. Rigid rows may
/// move at `tolerance` afterwards [m/s].
void solveByNewton(std::span<ContactBlock> blocks, std::span<JointBlock> joints,
                   std::span<const std::uint32_t> bodies, std::vector<SolverVelocity>& u,
                   double tolerance = 0.0);

}  // namespace merge2d
