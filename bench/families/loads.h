#pragma once
/// The loads under which structures fall: scripted motions, and forces that grow.

#include "bench/families/structure.h"

namespace merge2d::bench {

inline constexpr double kSettled = 2.0;  ///< when loads begin [s]

void move(BodyDesc& body, const Script& script);

/// Stays until a time and has moved by a way some seconds later.
Script shifted(const Vec2& at, double from, double seconds, const Vec2& way);

/// Turns by an angle about the origin of the frame.
Script turned(const Vec2& at, double from, double seconds, double angle);

/// Swings sideways with a growing amplitude, up to an acceleration after some seconds.
Script shaken(const Vec2& at, double acceleration, double period, double seconds);

double massOf(const BodyDesc& body);
/// Of all dynamic bodies [kg].
double massOf(const Scene& scene);

/// A force that grows by `rate` [N/s] from the time `from` on: a weak spring to a hand that goes
/// far away.
void pullMoreAndMore(Scene& scene, BodyIndex body, const Vec2& anchor, const Vec2& direction,
                     double rate, double from, double until);

}  // namespace merge2d::bench
