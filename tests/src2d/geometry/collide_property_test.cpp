/// Properties that hold for any two shapes, against brute force in double.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numbers>

#include "src2d/geometry/collide.h"
#include "tests/support/random.h"

namespace merge2d {
namespace {

// Box2D keeps A's face unless B's separates better by a tenth of its linear slop. [m]
constexpr double kPreference = 5.2e-4;

/// A polygon inscribed in an ellipse, somewhere in its body's frame.
Polygon anyPolygon() {
  const int n = *rc::gen::inRange(3, 9);
  const double width = uniform(0.1, 2.0);
  const double height = uniform(0.1, 2.0);
  const Pose pose = Pose::at({uniform(-3.0, 3.0), uniform(-3.0, 3.0)}, uniform(-3.0, 3.0));
  Polygon polygon;
  for (int i = 0; i < n; ++i) {
    const Vec2 p = Rotation::of(2.0 * std::numbers::pi * i / n) * Vec2(1.0, 0.0);
    polygon.vertices.push_back(pose * Vec2(width * p.x(), height * p.y()));
  }
  return polygon;
}

std::vector<Vec2> placed(const Collider& collider, const Pose& pose) {
  std::vector<Vec2> points;
  for (int i = 0; i < collider.count(); ++i) points.push_back(pose * collider.vertex(i));
  return points;
}

/// The largest separation of `b` from a face of `a`.
double separation(const Collider& a, const Collider& b, const Pose& b_in_a) {
  double most = -1e300;
  for (int i = 0; i < a.count(); ++i) {
    double least = 1e300;
    for (const Vec2& p : placed(b, b_in_a)) {
      least = std::min(least, a.normal(i).dot(p - a.vertex(i)));
    }
    most = std::max(most, least);
  }
  return most;
}

double distanceToOutline(const Vec2& p, const std::vector<Vec2>& outline) {
  double least = 1e300;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 edge = outline[(i + 1) % outline.size()] - outline[i];
    const double t = std::clamp(edge.dot(p - outline[i]) / edge.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p - outline[i] - t * edge).norm());
  }
  return least;
}

/// Of polygons that do not overlap.
double distance(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double least = 1e300;
  for (const Vec2& p : a) least = std::min(least, distanceToOutline(p, b));
  for (const Vec2& p : b) least = std::min(least, distanceToOutline(p, a));
  return least;
}

/// A pose of `b` at which the separation along some direction is `gap`.
Pose anyPoseAt(double gap, const Collider& a, const Collider& b) {
  Pose pose = Pose::at({0.0, 0.0}, uniform(-3.1, 3.1));
  const Vec2 direction = Rotation::of(uniform(-3.1, 3.1)) * Vec2(1.0, 0.0);
  pose.position = a.origin() - pose * b.origin();
  // Separation grows along the ray out of the middle: halve the interval.
  const Vec2 start = pose.position;
  double low = 0.0;
  double high = 10.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    pose.position = start + middle * direction;
    const double here = std::max(separation(a, b, pose), separation(b, a, pose.inverse()));
    (here < gap ? low : high) = middle;
  }
  return pose;
}

double leastGap(const Manifold& m) {
  double least = m.points[0].gap;
  if (m.count == 2) least = std::min(least, m.points[1].gap);
  return least;
}

RC_GTEST_PROP(CollideProperty, GapIsTheDistanceOfPolygonsApart, ()) {
  const Collider a(anyPolygon());
  const Collider b(anyPolygon());
  const Pose pose = anyPoseAt(uniform(1e-3, 15e-3), a, b);
  const double truth = distance(placed(a, {}), placed(b, pose));
  const Manifold m = collide(a, b, pose, 0.02);
  if (truth > 0.02) {
    RC_ASSERT(m.count == 0 || leastGap(m) < 0.02);
    return;
  }
  RC_ASSERT(m.count > 0);
  RC_ASSERT(std::abs(leastGap(m) - truth) < 3.0 * kPreference);  // faces over corners, too
}

RC_GTEST_PROP(CollideProperty, DeepestPointOfAnOverlapIsItsLeastSeparation, ()) {
  const Collider a(anyPolygon());
  const Collider b(anyPolygon());
  const Pose pose = anyPoseAt(uniform(-0.2, -2e-3), a, b);
  const double truth = std::max(separation(a, b, pose), separation(b, a, pose.inverse()));
  const Manifold m = collide(a, b, pose, 0.005);
  RC_ASSERT(m.count > 0);
  RC_ASSERT(leastGap(m) > truth - kPreference);
  RC_ASSERT(leastGap(m) < 0.0);
}

/// A pose at which a corner of `b` is within 0.3 mm of a corner of `a`, either way.
Pose anyPoseAtACorner(const Collider& a, const Collider& b) {
  Pose pose = Pose::at({0.0, 0.0}, uniform(-3.1, 3.1));
  const Vec2& corner = a.vertex(*rc::gen::inRange(0, a.count()));
  const Vec2 offset(uniform(-3e-4, 3e-4), uniform(-3e-4, 3e-4));
  pose.position = corner + offset - pose * b.vertex(*rc::gen::inRange(0, b.count()));
  return pose;
}

RC_GTEST_PROP(CollideProperty, CornersInOnePlaceTouchWhenTheyOverlap, ()) {
  const Collider a(anyPolygon());
  const Collider b(anyPolygon());
  const Pose pose = anyPoseAtACorner(a, b);
  const double truth = std::max(separation(a, b, pose), separation(b, a, pose.inverse()));
  const Manifold m = collide(a, b, pose, 0.005);
  if (truth < -1.001e-4) RC_ASSERT(m.count > 0 && leastGap(m) < 0.0);
  if (m.count > 0) RC_ASSERT(leastGap(m) > truth - kPreference);
}

RC_GTEST_PROP(CollideProperty, PointsLieMidwayBetweenTheOutlines, ()) {
  const Collider a(anyPolygon());
  const Collider b(anyPolygon());
  const Pose pose = anyPoseAt(uniform(0.0, 5e-3), a, b);
  const Manifold m = collide(a, b, pose, 0.005);
  RC_ASSERT(std::abs(m.normal.norm() - 1.0) < 1e-12);
  for (std::size_t i = 0; i < static_cast<std::size_t>(m.count); ++i) {
    const Vec2 half = 0.5 * m.points[i].gap * m.normal;
    RC_ASSERT(distanceToOutline(m.points[i].position - half, placed(a, {})) < 1e-12);
    RC_ASSERT(distanceToOutline(m.points[i].position + half, placed(b, pose)) < 1e-12);
  }
}

RC_GTEST_PROP(CollideProperty, SwappedBodiesSeeTheSameContactFromTheOtherSide, ()) {
  const Collider a(anyPolygon());
  const Collider b(anyPolygon());
  const Pose pose = anyPoseAt(uniform(-5e-3, 5e-3), a, b);
  RC_PRE(std::abs(separation(a, b, pose) - separation(b, a, pose.inverse())) > kPreference);
  const Manifold ab = collide(a, b, pose, 0.005);
  const Manifold ba = collide(b, a, pose.inverse(), 0.005);
  RC_ASSERT(ab.count == ba.count);
  if (ab.count == 0) return;
  RC_ASSERT((pose.rotation * ba.normal + ab.normal).norm() < 1e-12);
  for (std::size_t i = 0; i < static_cast<std::size_t>(ab.count); ++i) {
    // Either counts counter-clockwise along its own face.
    const ManifoldPoint& other = ba.points[static_cast<std::size_t>(ba.count) - 1 - i];
    RC_ASSERT(std::abs(ab.points[i].gap - other.gap) < 1e-12);
    RC_ASSERT((ab.points[i].position - pose * other.position).norm() < 1e-12);
  }
}

RC_GTEST_PROP(CollideProperty, ContactDoesNotDependOnWhereInTheWorldItIs, ()) {
  const Collider a(anyPolygon());
  const Collider b(anyPolygon());
  const Pose b_in_a = anyPoseAt(uniform(-5e-3, 5e-3), a, b);
  const Pose place = Pose::at({uniform(-1e4, 1e4), uniform(-1e4, 1e4)}, uniform(-3.0, 3.0));
  const Manifold here = collide(a, b, b_in_a, 0.005);
  const Manifold there = collide(a, b, place.inverse() * (place * b_in_a), 0.005);
  RC_ASSERT(here.count == there.count);
  for (std::size_t i = 0; i < static_cast<std::size_t>(here.count); ++i) {
    RC_ASSERT(here.points[i].feature == there.points[i].feature);
    RC_ASSERT(std::abs(here.points[i].gap - there.points[i].gap) < 1e-10);
    RC_ASSERT((here.points[i].position - there.points[i].position).norm() < 1e-9);
  }
}

RC_GTEST_PROP(CollideProperty, GapOfADiscIsItsDistance, ()) {
  const Collider polygon(anyPolygon());
  const double radius = uniform(0.05, 1.0);
  const Collider disc(Circle{{uniform(-1.0, 1.0), uniform(-1.0, 1.0)}, radius});
  const Vec2 center(uniform(-6.0, 6.0), uniform(-6.0, 6.0));
  Pose pose = Pose::at({0.0, 0.0}, uniform(-3.0, 3.0));
  pose.position = center - pose * disc.origin();

  double outside = -1e300;
  for (int i = 0; i < polygon.count(); ++i) {
    outside = std::max(outside, polygon.normal(i).dot(center - polygon.vertex(i)));
  }
  const double away = distanceToOutline(center, placed(polygon, {}));
  const double truth = (outside > 0.0 ? away : -away) - radius;
  const Manifold m = collide(polygon, disc, pose, 5.0);
  const Manifold back = collide(disc, polygon, pose.inverse(), 5.0);
  if (truth > 5.0) {
    RC_ASSERT(m.count == 0);
    return;
  }
  RC_ASSERT(m.count == 1);
  RC_ASSERT(back.count == 1);
  RC_ASSERT(std::abs(m.points[0].gap - truth) < 1e-6);
  RC_ASSERT(std::abs(back.points[0].gap - m.points[0].gap) < 1e-6);
}

}  // namespace
}  // namespace merge2d
