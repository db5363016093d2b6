#pragma once
/// How soft the contacts of small bodies are.

#include "src2d/scene/settings.h"

namespace merge2d {

/// `solver.compliance` for bodies of a size [m] that fall by `fall` [m] in a step. Under a weight
/// that is a given multiple of its own a body yields by the fall and not by its size, so that ten
/// plates of 5 mm would be pushed into each other: small bodies are harder, and the uppermost of
/// ten sinks by 4 % of its size at most.
inline double complianceFor(const SolverSettings& settings, double size, double fall) {
  constexpr double kSink = 8e-4;  // of the size, for each of the 50 weights of a stack of ten
  const double most = kSink * size * settings.erp;
  return settings.compliance * fall > most ? most / fall : settings.compliance;
}

}  // namespace merge2d
