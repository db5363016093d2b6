#include "src2d/body_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src2d/geometry/distance.h"

namespace merge2d {
namespace {

/// The way of a ray inside of a half-plane or a disc: [enter, leave], and the surface at `enter`.
struct Passage {
  double enter = 0.0, leave = 1.0;
  Vec2 normal = Vec2::Zero();

  void cut(double from, double to, const Vec2& surface) {
    if (from > enter) {
      enter = from;
      normal = surface;
    }
    leave = std::min(leave, to);
  }
  bool empty() const { return enter > leave; }
};

constexpr double kInfinite = std::numeric_limits<double>::infinity();

bool contains(const ConvexShape& shape, const Vec2& p) {
  if (const auto* circle = std::get_if<Circle>(&shape)) {
    return (p - circle->center).squaredNorm() <= circle->radius * circle->radius;
  }
  const auto& vertices = std::get<Polygon>(shape).vertices;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec2& begin = vertices[i];
    if (cross(Vec2(vertices[(i + 1) % vertices.size()] - begin), Vec2(p - begin)) < 0.0)
      return false;
  }
  return true;
}

Passage through(const Circle& circle, const Vec2& from, const Vec2& way) {
  Passage inside;
  const Vec2 start = from - circle.center;
  const double a = way.squaredNorm(), b = start.dot(way);
  const double c = start.squaredNorm() - circle.radius * circle.radius;
  if (a == 0.0) {
    if (c > 0.0) inside.leave = -1.0;
    return inside;
  }
  const double root = b * b - a * c;
  if (root < 0.0) {
    inside.leave = -1.0;
    return inside;
  }
  const double enter = (-b - std::sqrt(root)) / a, leave = (-b + std::sqrt(root)) / a;
  inside.cut(enter, leave, (start + enter * way) / circle.radius);
  return inside;
}

Passage through(const Polygon& polygon, const Vec2& from, const Vec2& way) {
  Passage inside;
  const auto& vertices = polygon.vertices;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec2 edge = vertices[(i + 1) % vertices.size()] - vertices[i];
    const Vec2 outward = -perpendicular(edge).normalized();
    const double ahead = outward.dot(from - vertices[i]), speed = outward.dot(way);
    if (speed == 0.0) {
      if (ahead > 0.0) inside.leave = -1.0;
    } else if (speed < 0.0) {
      inside.cut(-ahead / speed, kInfinite, outward);
    } else {
      inside.cut(-kInfinite, -ahead / speed, outward);
    }
  }
  return inside;
}

Passage through(const ConvexShape& shape, const Vec2& from, const Vec2& way) {
  if (const auto* circle = std::get_if<Circle>(&shape)) return through(*circle, from, way);
  return through(std::get<Polygon>(shape), from, way);
}

}  // namespace

void BodyLocator::update(const World& world) {
  bodies_ = &world.bodies();
  poses_.resize(3 * bodies_->size());
  world.poses(poses_);
  boxes_.assign(bodies_->size(), Aabb{});
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const auto placed = pose(BodyId{static_cast<std::uint32_t>(i)});
    if (!placed) continue;
    for (const ConvexShape& shape : (*bodies_)[i].shapes) boxes_[i].include(bounds(shape, *placed));
  }
}

std::optional<Pose> BodyLocator::pose(BodyId body) const {
  const double* row = poses_.data() + 3 * index(body);
  if (index(body) >= boxes_.size() || std::isnan(row[0])) return std::nullopt;
  return Pose::at({row[0], row[1]}, row[2]);
}

template <class Visit>
void BodyLocator::visit(const Aabb& box, Visit&& visit) const {
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (boxes_[i].empty() || !boxes_[i].overlaps(box)) continue;
    const BodyId body{static_cast<std::uint32_t>(i)};
    visit(body, (*bodies_)[i].shapes, *pose(body));
  }
}

std::vector<BodyId> BodyLocator::at(const Vec2& point) const {
  std::vector<BodyId> found;
  visit({point, point}, [&](BodyId body, const auto& shapes, const Pose& pose) {
    const Vec2 p = pose.toLocal(point);
    if (std::any_of(shapes.begin(), shapes.end(), [&](const auto& s) { return contains(s, p); })) {
      found.push_back(body);
    }
  });
  return found;
}

std::vector<BodyId> BodyLocator::touching(const std::vector<ConvexShape>& shapes,
                                          const Pose& pose) const {
  Aabb box;
  std::vector<Collider> asked;
  for (const ConvexShape& shape : shapes) {
    box.include(bounds(shape, pose));
    asked.emplace_back(shape);
  }
  std::vector<BodyId> found;
  visit(box, [&](BodyId body, const auto& pieces, const Pose& at) {
    const Pose piece_in_asked = pose.toLocal(at);
    const bool touches = std::any_of(pieces.begin(), pieces.end(), [&](const ConvexShape& piece) {
      const Collider collider(piece);
      return std::any_of(asked.begin(), asked.end(), [&](const Collider& shape) {
        return nearest(shape, collider, piece_in_asked).distance <= 0.0;
      });
    });
    if (touches) found.push_back(body);
  });
  return found;
}

std::optional<RayHit> BodyLocator::castRay(const Vec2& from, const Vec2& to) const {
  Aabb box;
  box.include(from);
  box.include(to);
  std::optional<RayHit> first;
  visit(box, [&](BodyId body, const auto& shapes, const Pose& pose) {
    const Vec2 start = pose.toLocal(from), way = pose.rotation.inverse() * Vec2(to - from);
    for (const ConvexShape& shape : shapes) {
      const Passage inside = through(shape, start, way);
      if (inside.empty() || (first && inside.enter >= first->fraction)) continue;
      first = RayHit{.body = body,
                     .fraction = inside.enter,
                     .point = from + inside.enter * (to - from),
                     .normal = pose.rotation * inside.normal};
    }
  });
  return first;
}

}  // namespace merge2d
