#pragma once
/// How a rigid thing moves at every point.

#include "src2d/core/vec.h"

namespace merge2d {

/// A rigid velocity field: `v` at the point `x`, turning with `omega`.
struct VelocityField {
  Vec2 x = Vec2::Zero();
  Vec2 v = Vec2::Zero();
  double omega = 0.0;
  Vec2 at(const Vec2& p) const { return v + cross(omega, p - x); }
};

}  // namespace merge2d
