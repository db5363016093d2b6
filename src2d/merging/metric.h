#pragma once
/// The relative motion metric (Section 5.2): the fastest point of two bodies against each other,
/// over the corners of both oriented boxes.

#include "src2d/geometry/box.h"

namespace merge2d {

/// A rigid velocity field: `v` at the point `x`, turning with `omega`.
struct VelocityField {
  Vec2 x = Vec2::Zero();
  Vec2 v = Vec2::Zero();
  double omega = 0.0;
  Vec2 at(const Vec2& p) const { return v + cross(omega, p - x); }
};

/// Largest |v_rel(p)| over the corners p of `box` [m/s], Eqs. (15) and (16).
inline double fastestCorner(const OrientedBox& box, const VelocityField& a,
                            const VelocityField& b) {
  double fastest = 0.0;
  for (const Vec2& p : box.corners()) {
    fastest = std::max(fastest, (a.at(p) - b.at(p)).squaredNorm());
  }
  return std::sqrt(fastest);
}

}  // namespace merge2d
