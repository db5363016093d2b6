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
  std::vector<BodyDesc> added;  ///< bodies that came in while it ran, behind those of the scene
};

/// Fills `out`, which is new.
void setUp(const Scene& scene, Mode mode, Setup& out);

/// Appends a body, which is not there before bringIn. Collections make way: their rigid things get
/// other ids.
BodyId appendBody(Setup& setup, const BodyDesc& desc);

/// A joint between bodies as they stand now.
void appendJoint(State& state, const JointDesc& desc);

/// Anchors are kept from the centres of mass, which are given in the frames of the two bodies.
void appendSpring(Actions& actions, const SpringDesc& spring, const Vec2& center_of_body,
                  const Vec2& center_of_other);

/// The constant data of the bodies, by id.
std::vector<BodyInfo> describeBodies(const Scene& scene, const Setup& setup);

/// The description that a body was made from.
const BodyDesc& descriptionOf(const Scene& scene, const Setup& setup, BodyId body);

/// A body enters the simulation at the pose and velocity that its rigid thing holds.
void bringIn(State& state, BodyId body);

}  // namespace merge2d
