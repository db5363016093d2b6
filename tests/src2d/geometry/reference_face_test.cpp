#include "src2d/geometry/reference_face.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "src2d/geometry/collide_pairs.h"

namespace merge2d {
namespace {

class RandomPairs {
 public:
  double between(double least, double most) {
    return least + (most - least) * static_cast<double>(engine_()) / 4294967295.0;
  }
  /// A polygon of 3 to 8 vertices in an ellipse; every other one is a box.
  Collider polygon() {
    if (engine_() % 2 == 0) return Collider(makeBox(between(0.1, 2.0), between(0.1, 2.0)));
    const int n = 3 + static_cast<int>(engine_() % 6);
    const double width = between(0.1, 2.0), height = between(0.1, 2.0);
    Polygon polygon;
    for (int i = 0; i < n; ++i) {
      const Rotation turn = Rotation::of(2.0 * std::numbers::pi * i / n);
      polygon.vertices.emplace_back(width * turn.c, height * turn.s);
    }
    return Collider(polygon);
  }
  /// Often nearly upright, as in walls.
  b2Transform pose() {
    const double angle = engine_() % 2 == 0 ? between(-1e-3, 1e-3) : between(-4.0, 4.0);
    const Rotation turn = Rotation::of(angle);
    b2Transform xf;
    xf.p = toFloat({between(-2.0, 2.0), between(-2.0, 2.0)});
    xf.q.c = static_cast<float>(turn.c);
    xf.q.s = static_cast<float>(turn.s);
    return xf;
  }

 private:
  std::mt19937 engine_{11};
};

TEST(ReferenceFace, IsTheOneThatBox2DFinds) {
  RandomPairs random;
  int found = 0;
  for (int i = 0; i < 100'000; ++i) {
    const Collider a = random.polygon(), b = random.polygon();
    const b2Transform xf = random.pose();
    b2Manifold expected;
    b2CollidePolygons(&expected, &a.polygon(), identity(), &b.polygon(), xf);
    const float radius = a.polygon().m_radius + b.polygon().m_radius;
    FaceMemory none;
    const ReferenceFace face = referenceFace(a, b, xf, radius, none);
    ASSERT_EQ(face.found, expected.pointCount > 0) << i;
    if (!face.found) continue;
    ++found;
    ASSERT_EQ(face.swapped, expected.type == b2Manifold::e_faceB) << i;
    const b2PolygonShape& whose = face.swapped ? b.polygon() : a.polygon();
    ASSERT_EQ(face.face, faceWithMiddle(whose, expected.localPoint)) << i;
  }
  EXPECT_GT(found, 10'000);
}

/// Small motions of all sizes, also across the places where the face changes.
TEST(ReferenceFace, IsTheSameFromMemory) {
  RandomPairs random;
  int found = 0, from_memory = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Collider a = random.polygon(), b = random.polygon();
    b2Transform xf = random.pose();
    const double scale = std::pow(10.0, random.between(-7.0, -1.0));
    double angle = std::atan2(xf.q.s, xf.q.c);
    FaceMemory memory;
    for (int step = 0; step < 20; ++step) {
      xf.p += toFloat({random.between(-scale, scale), random.between(-scale, scale)});
      angle += random.between(-scale, scale);
      const Rotation turn = Rotation::of(angle);
      xf.q.c = static_cast<float>(turn.c);
      xf.q.s = static_cast<float>(turn.s);
      const float least = a.polygon().m_radius + b.polygon().m_radius;
      const float radius = least + static_cast<float>(std::max(0.0, random.between(-1e-3, 1e-3)));
      FaceMemory none;
      const ReferenceFace expected = referenceFace(a, b, xf, radius, none);
      const b2Vec2 before(memory.x, memory.y);
      const ReferenceFace face = referenceFace(a, b, xf, radius, memory);
      ASSERT_EQ(face.found, expected.found) << i;
      if (!face.found) continue;
      ASSERT_EQ(face.swapped, expected.swapped) << i;
      ASSERT_EQ(face.face, expected.face) << i;
      ++found;
      from_memory += before == b2Vec2(memory.x, memory.y) ? 1 : 0;
    }
  }
  EXPECT_GT(from_memory, found / 4);
}

}  // namespace
}  // namespace merge2d
