#pragma once
/// The face of two polygons that parts them best: Box2D's reference face. Not for other folders.

#include "src2d/geometry/collide.h"

namespace merge2d {

struct ReferenceFace {
  bool found = false;    ///< the polygons are near each other
  bool swapped = false;  ///< it is a face of B
  int face = 0;          ///< from this vertex to the next one
};

/// The same face, for points up to `radius` [m] apart, as b2CollidePolygons gives: with the same
/// operations on the same floats, but for several faces at once, and without the contact points,
/// which collidePolygons finds in double.
/// `b_in_a` is the pose of B's centre seen from A's. Sought only where the two have moved so far
/// since the last time that another face may be the one; `memory` is of that time.
/// Guarded by ReferenceFace.IsTheOneThatBox2DFinds and ReferenceFace.IsTheSameFromMemory.
ReferenceFace referenceFace(const Collider& a, const Collider& b, const b2Transform& b_in_a,
                            float radius, FaceMemory& memory);

}  // namespace merge2d
