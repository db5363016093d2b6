#pragma once
/// Contact manifolds between two convex shapes. Box2D finds the features; the relative pose and the
/// gaps are in double, seen from body A, so that precision does not depend on where in the world a
/// contact is.

#include <array>
#include <cstdint>

#include "src2d/geometry/shape.h"

namespace merge2d {

/// A shape prepared for collision: Box2D's float copy, seen from the shape's own centre so that a
/// shape far from its body's origin loses no precision, beside the exact vertices.
class Collider {
 public:
  explicit Collider(const ConvexShape& shape);

  const ConvexShape& shape() const { return shape_; }
  bool isCircle() const { return count_ == 0; }

  /// Box2D's copies, relative to `origin()`. Polygons carry half of `kUsualMargin` and a slack as
  /// radius.
  const b2CircleShape& circle() const { return circle_; }
  const b2PolygonShape& polygon() const { return polygon_; }

  static constexpr float kUsualMargin = 0.005F;  ///< [m]; half of it is in the polygons' radius

  const Vec2& origin() const { return origin_; }  ///< centre of disc or vertices, body frame [m]
  double radius() const { return radius_; }       ///< of a disc, 0 for polygons [m]
  float size() const { return size_; }  ///< no vertex is farther from `origin()`; 0 for discs [m]
  int count() const { return count_; }  ///< of vertices, 0 for discs

  /// Vertex i in the body's frame [m], and the outward normal of the face from it to the next one.
  const Vec2& vertex(int i) const { return vertices_[static_cast<std::size_t>(i)]; }
  const Vec2& normal(int i) const { return normals_[static_cast<std::size_t>(i)]; }
  int next(int i) const { return i + 1 < count_ ? i + 1 : 0; }

 private:
  void fill(const Circle& circle);
  void fill(const Polygon& polygon);

  int count_ = 0;
  float size_ = 0.0F;
  double radius_ = 0.0;
  Vec2 origin_ = Vec2::Zero();
  std::array<Vec2, Polygon::kMaxVertices> vertices_;
  std::array<Vec2, Polygon::kMaxVertices> normals_;
  b2CircleShape circle_;
  b2PolygonShape polygon_;
  ConvexShape shape_;
};

/// One contact point, seen from A's frame.
struct ManifoldPoint {
  Vec2 position = Vec2::Zero();  ///< midway between the two surfaces [m]
  double gap = 0.0;           ///< signed distance along the normal, negative when overlapping [m]
  std::uint32_t feature = 0;  ///< the pair of faces and the end of their overlap; 0 with a disc
};

/// At most two points that share a normal.
struct Manifold {
  Vec2 normal = Vec2::UnitX();  ///< from A to B, unit, in A's frame
  int count = 0;
  std::array<ManifoldPoint, 2> points;
};

/// The reference face of two polygons when it was last sought, and for how long it is the one: to
/// seek it takes longer than the rest of a manifold, and bodies in a pile hardly move against each
/// other. The manifold is the same, bit for bit, with this memory and without.
struct FaceMemory {
  float x = 0.0F, y = 0.0F;  ///< B's centre seen from A's, as then [m]
  float turn = 0.0F;         ///< of B against A (reference_face.cpp)
  std::uint16_t holds = 0;   ///< while all corners have moved by less [µm]; 0: nothing is known
  std::uint8_t face = 0;
  bool swapped = false;
};

/// The manifold of `a` and `b` when `b`'s body has the pose `b_in_a` in the frame of `a`'s body.
/// Points whose gap is above `margin` [m] are left out. `memory`, where there is one, is that of
/// these two shapes in this order.
Manifold collide(const Collider& a, const Collider& b, const Pose& b_in_a, double margin,
                 FaceMemory* memory = nullptr);

}  // namespace merge2d
