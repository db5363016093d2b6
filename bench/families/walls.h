#pragma once
/// Walls of boxes, on which most families stand.

#include <algorithm>

#include "bench/families/structure.h"

namespace merge2d::bench {

/// Boxes of one size in rows, of which every other is shifted.
struct Wall {
  int columns, rows;
  double width, height;  ///< of a box [m]
  double shift = 0.0;    ///< [m]

  double breadth() const { return columns * width; }
  double size() const { return std::min(width, height); }
  /// Acceleration sideways at which it tips or slides as one [m/s²].
  double carries(double friction) const {
    return kGravity * std::min(friction, (breadth() - shift) / (rows * height));
  }
};

/// Not broader and not higher than this [m].
Wall randomWall(Random& random, double breadth, double height);

/// Adds a wall with the middle of its foot at a place, moving with the first body, and watches it
/// from there.
void add(Structure& s, const Wall& wall, const Vec2& foot);

}  // namespace merge2d::bench
