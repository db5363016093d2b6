#pragma once
/// From a scene to the state before the first step.

#include <vector>

#include "src2d/dynamics/forces.h"
#include "src2d/dynamics/state.h"

namespace merge2d {

struct Setup {
  State state;
  Actions actions;
  std::vector<BodyInfo> bodies;
};

/// Fills `out`, which is new.
void setUp(const Scene& scene, Mode mode, Setup& out);

/// A body enters the simulation at the pose and velocity that its rigid thing holds.
void bringIn(State& state, BodyId body);

}  // namespace merge2d
