#pragma once
/// Which bodies are where: questions to the bodies of a world as they stand now.

#include <optional>
#include <vector>

#include "src2d/geometry/box.h"
#include "src2d/world.h"

namespace merge2d {

/// Where a ray meets a body first.
struct RayHit {
  BodyId body{};
  double fraction = 0.0;       ///< of the way: 0 where it begins, 1 where it ends
  Vec2 point = Vec2::Zero();   ///< [m]
  Vec2 normal = Vec2::Zero();  ///< of the surface, outwards; zero where the ray begins inside
};

/// The boxes of all bodies, looked at one after the other: a nanosecond each, and nothing to keep
/// up to date while nobody asks. Bodies are told in ascending order.
class BodyLocator {
 public:
  /// Looks at the world anew. It must live on, unchanged, while this is asked.
  void update(const World& world);

  /// Of the centre of mass; nothing for a body that is not in the world.
  std::optional<Pose> pose(BodyId body) const;

  /// Of which `point` is a part.
  std::vector<BodyId> at(const Vec2& point) const;
  /// That touch or overlap these shapes.
  std::vector<BodyId> touching(const std::vector<ConvexShape>& shapes, const Pose& pose) const;
  /// The first body on the way; of several in one place, the one with the lowest number.
  std::optional<RayHit> castRay(const Vec2& from, const Vec2& to) const;

 private:
  template <class Visit>
  void visit(const Aabb& box, Visit&& visit) const;

  const std::vector<BodyInfo>* bodies_ = nullptr;
  std::vector<double> poses_;  ///< x, y, angle
  std::vector<Aabb> boxes_;    ///< empty: not in the world
};

}  // namespace merge2d
