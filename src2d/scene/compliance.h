#pragma once
/// How soft the contacts of small bodies are.

#include "src2d/scene/settings.h"

namespace merge2d {

/// How far small bodies sink in at most, for each of the 50 weights of a stack of ten [1, of the
/// size].
inline constexpr double kSinkOfSmall = 8e-4;

/// `solver.compliance` for bodies of a size [m] that fall by `fall` [m] in a step. Under a weight
/// that is a given multiple of its own a body yields by the fall and not by its size, so that ten
/// plates of 5 mm would be pushed into each other: small bodies are harder, and the uppermost of
/// ten sinks by 4 % of its size at most.
inline double complianceFor(const SolverSettings& settings, double size, double fall) {
  const double most = kSinkOfSmall * size * settings.erp;
  return settings.compliance * fall > most ? most / fall : settings.compliance;
}

}  // namespace merge2d
