#pragma once
/// How fast the two bodies of a pair move against each other, and the scale of thresholds by their
/// size (Section 5.2).

#include <algorithm>

#include "src2d/dynamics/state.h"
#include "src2d/merging/metric.h"

namespace merge2d {

/// The factor on the thresholds for bodies of a size [m]: a hundredth of a metre per second is
/// little for a brick, and a hundred times its size per second for a grain of 0.1 mm.
inline double thresholdScale(double size) {
  constexpr double kUsual = 0.1;  // [m]
  return std::min(1.0, size / kUsual);
}

/// The motion of a rigid thing as a field, and its box, in the world.
VelocityField motionField(const Rigid& r);
OrientedBox worldBox(const State& state, const Rigid& r);

/// With `merging.metric = "naive"` the contacts of a pair are looked at instead of boxes; a pair
/// may be held by joints alone.
bool isNaive(const State& state, const BodyPair& pair);

/// Eq. (15); only the boxes of floating things are looked at [m/s]. With `merging.metric = "naive"`
/// only the contacts of a pair are.
double relativeMotion(const State& state, const BodyPair& pair);

/// Notes the relative velocities that Eq. (15) looks at, if somebody asks.
void noteCorners(const State& state, const BodyPair& pair, Notes* notes);

}  // namespace merge2d
