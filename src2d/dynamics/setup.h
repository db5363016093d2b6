#pragma once
/// From a scene to the state before the first step.

#include <vector>

#include "src2d/dynamics/forces.h"
#include "src2d/dynamics/state.h"
#include "src2d/trace/snapshot.h"

namespace merge2d {

struct Setup {
  State state;
  Actions actions;
};

/// Fills `out`, which is new.
void setUp(const Scene& scene, Mode mode, Setup& out);

/// What never changes about the bodies of a state that was set up from the scene, by id.
std::vector<BodyInfo> describeBodies(const Scene& scene, const State& state);

/// A body enters the simulation at the pose and velocity that its rigid thing holds.
void bringIn(State& state, BodyId body);

}  // namespace merge2d
