#pragma once
/// Plane vectors. Eigen supplies the type; the few plane-only products live here.

#include <Eigen/Core>
#include <cmath>

namespace merge2d {

using Vec2 = Eigen::Vector2d;

/// z component of the cross product of two plane vectors.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// omega × r: the velocity of the point at `r` [m] on a body that turns with `omega` [rad/s].
inline Vec2 cross(double omega, const Vec2& r) { return {-omega * r.y(), omega * r.x()}; }

/// The vector turned by +90 degrees.
inline Vec2 perpendicular(const Vec2& a) { return {-a.y(), a.x()}; }

}  // namespace merge2d
