#pragma once
/// The forces of springs: those of an explicit step, or where these would add energy to their
/// bodies for long, those of an implicit one, which damps.

#include "src2d/dynamics/forces.h"

namespace merge2d {

/// Appends the forces of the springs of this step to `scratch.loads`, and lists the springs in
/// `scratch.springs`.
void addSprings(const State& state, const Actions& actions, Scratch& scratch);

/// Stretching energy of all springs [J].
double springEnergy(const State& state, const Actions& actions);

}  // namespace merge2d
