#pragma once
/// Whether a scene can be simulated: the rules that loading a file enforces, for scenes that a
/// program has built. Each function throws the InputError of the first fault that it
/// finds, in the words of a file: "'mass' in body 'a' must be positive (1e-12 to 1e12), but is
/// -1.0".

#include "src2d/scene/scene.h"

namespace merge2d {

/// All of a scene: numbers in their ranges, counts, references, and contradictions.
void check(const Scene& scene);
/// The same without title, camera and duration, which a simulation does not see.
void checkSimulated(const Scene& scene);

/// One body; `checkSpring` and `checkJoint` leave the bodies that are meant to the caller.
void checkBody(const BodyDesc& body);
void checkSpring(const SpringDesc& spring);
void checkJoint(const JointDesc& joint);
void checkSettings(const Settings& settings);
/// Of a world that runs [s].
void checkTimeStep(double h);

}  // namespace merge2d
