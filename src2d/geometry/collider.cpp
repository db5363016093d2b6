/// Box2D's polygons are filled directly: its Set() would reorder vertices, so that face indices no
/// longer agree with ours, and weld those nearer than 2.5 mm.

#include <algorithm>
#include <cmath>

#include "src2d/core/assert.h"
#include "src2d/geometry/collide_pairs.h"

namespace merge2d {

Collider::Collider(const ConvexShape& shape) : shape_(shape) {
  vertices_.fill(Vec2::Zero());
  normals_.fill(Vec2::Zero());
  std::visit([this](const auto& s) { fill(s); }, shape_);
}

void Collider::fill(const Circle& circle) {
  MERGE2D_ASSERT(circle.radius > 0.0, "a disc's radius must be positive, not {}", circle.radius);
  origin_ = circle.center;
  radius_ = circle.radius;
  circle_.m_p.SetZero();
  circle_.m_radius = static_cast<float>(radius_);
}

void Collider::fill(const Polygon& polygon) {
  const std::size_t count = polygon.vertices.size();
  MERGE2D_ASSERT(count >= 3 && count <= Polygon::kMaxVertices, "{} vertices", count);
  for (const Vec2& v : polygon.vertices) origin_ += v / static_cast<double>(count);

  // Faces are compared by fours (reference_face.cpp). Sums of numbers left in memory, which may be
  // subnormal, take a hundred times as long as those of zeros.
  std::ranges::fill(polygon_.m_vertices, b2Vec2(0.0F, 0.0F));
  std::ranges::fill(polygon_.m_normals, b2Vec2(0.0F, 0.0F));
  for (std::size_t i = 0; i < count; ++i) {
    vertices_[i] = polygon.vertices[i];
    const Vec2 edge = polygon.vertices[(i + 1) % count] - vertices_[i];
    normals_[i] = -perpendicular(edge).normalized();
    polygon_.m_vertices[i] = toFloat(vertices_[i] - origin_);
    polygon_.m_normals[i] = toFloat(normals_[i]);
    size_ =
        std::max(size_, std::abs(polygon_.m_vertices[i].x) + std::abs(polygon_.m_vertices[i].y));
  }
  count_ = polygon_.m_count = static_cast<int>(count);
  polygon_.m_centroid.SetZero();
  polygon_.m_radius = 0.5F * (kUsualMargin + kFloatSlack);
}

}  // namespace merge2d
