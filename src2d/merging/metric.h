#pragma once
/// The relative motion metric (Section 5.2): the fastest point of two bodies against each other,
/// over the corners of both oriented boxes.

#include "src2d/dynamics/velocity_field.h"
#include "src2d/geometry/box.h"

namespace merge2d {

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
