#include "src2d/geometry/collide.h"

#include "src2d/geometry/collide_pairs.h"

namespace merge2d {

Manifold collide(const Collider& a, const Collider& b, const Pose& b_in_a, double margin,
                 FaceMemory* memory) {
  if (!a.isCircle() && !b.isCircle()) {
    FaceMemory none;
    return collidePolygons(a, b, b_in_a, margin, memory ? *memory : none);
  }
  if (!a.isCircle())
    return collidePolygonAndDisc(a, b_in_a.exactly(b.origin()), b.radius(), margin);
  if (b.isCircle()) {
    return collideDiscs(a.origin(), a.radius(), b_in_a.exactly(b.origin()), b.radius(), margin);
  }
  // The disc is A: look from B, then turn around.
  Manifold m = collidePolygonAndDisc(b, b_in_a.toLocal(a.origin()), a.radius(), margin);
  m.normal = -(b_in_a.rotation * m.normal);
  for (ManifoldPoint& p : m.points) p.position = b_in_a.exactly(p.position);
  return m;
}

}  // namespace merge2d
