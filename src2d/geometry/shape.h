#pragma once
/// Convex shapes, the only geometry the engine collides. A body is one or more of them.

#include <box2d/b2_circle_shape.h>
#include <box2d/b2_polygon_shape.h>

#include <variant>
#include <vector>

#include "src2d/core/pose.h"

namespace merge2d {

/// A disc in its body's frame.
struct Circle {
  Vec2 center = Vec2::Zero();  ///< [m]
  double radius = 0.5;         ///< [m]
};

/// A convex polygon in its body's frame, counter-clockwise, 3 to `kMaxVertices` vertices.
struct Polygon {
  static constexpr std::size_t kMaxVertices = 8;  // b2_maxPolygonVertices
  std::vector<Vec2> vertices;                     ///< [m]
};

using ConvexShape = std::variant<Circle, Polygon>;

/// The box of `width` × `height` [m] about the origin of `pose`, as a polygon.
Polygon makeBox(double width, double height, const Pose& pose = {});

/// The same shape seen from a frame in which its own frame has the pose `pose`.
ConvexShape transformed(const ConvexShape& shape, const Pose& pose);

/// Area, centroid and second moment of area about the centroid.
struct AreaProperties {
  double area = 0.0;             ///< [m²]
  Vec2 centroid = Vec2::Zero();  ///< [m]
  double secondMoment = 0.0;     ///< polar, about the centroid [m⁴]
};
AreaProperties areaProperties(const ConvexShape& shape);
/// Of shapes that do not overlap, by the parallel axis theorem.
AreaProperties areaProperties(const std::vector<ConvexShape>& shapes);

/// Cuts a simple polygon, convex or not, in either orientation, into convex polygons of at most
/// `Polygon::kMaxVertices` vertices that cover it without overlap. Collinear and repeated vertices
/// are dropped. Throws InputError (without a place) when it crosses or touches itself, has fewer
/// than three distinct vertices or no area.
std::vector<Polygon> convexPieces(const std::vector<Vec2>& outline);

}  // namespace merge2d
