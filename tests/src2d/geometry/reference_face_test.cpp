#include "src2d/geometry/reference_face.h"

#include <gtest/gtest.h>

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
    const ReferenceFace face = referenceFace(a.polygon(), b.polygon(), xf, radius);
    ASSERT_EQ(face.found, expected.pointCount > 0) << i;
    if (!face.found) continue;
    ++found;
    ASSERT_EQ(face.swapped, expected.type == b2Manifold::e_faceB) << i;
    const b2PolygonShape& whose = face.swapped ? b.polygon() : a.polygon();
    ASSERT_EQ(face.face, faceWithMiddle(whose, expected.localPoint)) << i;
  }
  EXPECT_GT(found, 10'000);
}

}  // namespace
}  // namespace merge2d
