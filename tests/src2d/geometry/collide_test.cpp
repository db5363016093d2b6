#include "src2d/geometry/collide.h"

#include <gtest/gtest.h>

#include <numbers>

namespace merge2d {
namespace {

constexpr double kMargin = 0.005;

Pose at(double x, double y, double angle = 0.0) { return Pose::at({x, y}, angle); }
Collider box(double width, double height) { return Collider(makeBox(width, height)); }

TEST(Collide, SeesABoxOnAFloorAtTwoPoints) {
  const Manifold m = collide(box(20.0, 1.0), box(1.0, 1.0), at(3.0, 1.0), kMargin);
  ASSERT_EQ(m.count, 2);
  EXPECT_EQ(m.normal, Vec2(0.0, 1.0));
  // Counter-clockwise along A's face.
  EXPECT_EQ(m.points[0].position, Vec2(3.5, 0.5));
  EXPECT_EQ(m.points[1].position, Vec2(2.5, 0.5));
  EXPECT_EQ(m.points[0].gap, 0.0);
  EXPECT_EQ(m.points[1].gap, 0.0);
  EXPECT_NE(m.points[0].feature, m.points[1].feature);
}

TEST(Collide, GapsAreExactToTheLastBitsOfADouble) {
  for (const double gap : {-1e-3, -1e-9, 1e-12, 1e-9, 1e-3}) {
    const Manifold m = collide(box(20.0, 1.0), box(1.0, 1.0), at(7.3, 1.0 + gap), kMargin);
    ASSERT_EQ(m.count, 2);
    for (const ManifoldPoint& p : m.points) {
      EXPECT_NEAR(p.gap, gap, 1e-15);
      EXPECT_NEAR(p.position.y(), 0.5 + 0.5 * gap, 1e-15);
    }
  }
}

TEST(Collide, LeavesOutPointsBeyondTheMargin) {
  EXPECT_EQ(collide(box(4.0, 1.0), box(1.0, 1.0), at(0.0, 1.0051), kMargin).count, 0);
  EXPECT_EQ(collide(box(4.0, 1.0), box(1.0, 1.0), at(0.0, 1.0049), kMargin).count, 2);
  EXPECT_EQ(collide(box(4.0, 1.0), box(1.0, 1.0), at(0.0, 1.09), 0.1).count, 2);
  EXPECT_EQ(collide(box(4.0, 1.0), box(1.0, 1.0), at(0.0, 1.11), 0.1).count, 0);
  // A tilted box comes close with one corner only.
  const double half_height = std::sin(0.1 + std::numbers::pi / 4.0) * std::numbers::sqrt2 / 2.0;
  const Manifold m =
      collide(box(4.0, 1.0), box(1.0, 1.0), at(0.0, 0.5 + half_height, 0.1), kMargin);
  ASSERT_EQ(m.count, 1);
  EXPECT_NEAR(m.points[0].gap, 0.0, 1e-15);
}

TEST(Collide, CutsContactAtTheEndOfTheSupport) {
  // Half of the upper box hangs over, with any margin.
  for (const double margin : {0.005, 0.2}) {
    const Manifold m = collide(box(2.0, 1.0), box(1.0, 1.0), at(1.0, 1.0), margin);
    ASSERT_EQ(m.count, 2);
    EXPECT_EQ(m.points[0].position, Vec2(1.0, 0.5));
    EXPECT_EQ(m.points[1].position, Vec2(0.5, 0.5));
  }
}

TEST(Collide, KeepsTheNamesOfPointsWhileABoxSlidesOverAnEnd) {
  const Collider floor = box(2.0, 1.0);
  const Collider brick = box(1.0, 1.0);
  const Manifold inside = collide(floor, brick, at(0.4999, 1.0), kMargin);
  for (const double x : {0.5 - 1e-16, 0.5, 0.5 + 1e-16, 0.501, 0.6, 1.2}) {
    const Manifold m = collide(floor, brick, at(x, 1.0), kMargin);
    ASSERT_EQ(m.count, 2);
    EXPECT_EQ(m.points[0].feature, inside.points[0].feature);
    EXPECT_EQ(m.points[1].feature, inside.points[1].feature);
  }
}

TEST(Collide, KeepsTheNamesOfPointsWhenTheOtherBodyGivesTheReferenceFace) {
  // Tilted by more than Box2D's tolerance either the one or the other face separates better.
  const Collider wide = box(1.0, 1.0);
  const Collider narrow = box(0.5, 1.0);
  const Pose pose = at(0.0, 1.0 - 2e-3, 5e-3);
  const Manifold ab = collide(wide, narrow, pose, kMargin);
  const Manifold level = collide(wide, narrow, at(0.0, 1.0), kMargin);
  const Manifold lifted = collide(narrow, wide, pose, kMargin);
  const Manifold lifted_level = collide(narrow, wide, at(0.0, 1.0), kMargin);
  ASSERT_EQ(ab.count, 2);
  ASSERT_EQ(lifted.count, 2);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(ab.points[i].feature, level.points[i].feature);
    EXPECT_EQ(lifted.points[i].feature, lifted_level.points[i].feature);
  }
}

TEST(Collide, DoesNotCatchABoxThatFallsPastACorner) {
  // 2 mm beside the face: the normal points from corner to corner, not up.
  const Manifold m = collide(box(2.0, 2.0), box(1.0, 1.0), at(1.502, 1.501), kMargin);
  ASSERT_EQ(m.count, 1);
  EXPECT_NEAR((m.normal - Vec2(2.0, 1.0).normalized()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(m.points[0].gap, std::hypot(0.002, 0.001), 1e-12);
  EXPECT_NEAR((m.points[0].position - Vec2(1.001, 1.0005)).norm(), 0.0, 1e-12);
}

TEST(Collide, SeesNothingBetweenBoxesThatTouchAtACornerOnly) {
  for (const double noise : {-1e-12, 0.0, 1e-12}) {
    EXPECT_EQ(collide(box(1.0, 1.0), box(1.0, 1.0), at(1.0, 1.0 + noise), kMargin).count, 0);
  }
}

TEST(Collide, ACornerBesideAFaceDoesNotOverlapIt) {
  // The point of a wedge is just beside the box's corner, and a little lower. The wedge's left face
  // parts them by 16 µm, but Box2D prefers the box's own upper face by up to half a millimetre.
  const Collider square(Polygon{{{-1.0, -1.0}, {0.0, -1.0}, {0.0, 0.0}, {-1.0, 0.0}}});
  const auto wedge = [](double x) {
    return Collider(Polygon{{{x, -2e-4}, {1.0, 3.0}, {-0.5, 3.0}}});
  };
  EXPECT_EQ(collide(square, wedge(5e-5), at(0.0, 0.0), kMargin).count, 0);
  const Manifold overlapping = collide(square, wedge(-0.1), at(0.0, 0.0), kMargin);
  ASSERT_EQ(overlapping.count, 1);
  EXPECT_NEAR(overlapping.points[0].gap, -2e-4, 1e-12);
}

TEST(Collide, ACornerBesideAFaceMayOverlapByAnother) {
  // As above, but the wedge's left face lies flatter and cuts off the box's corner.
  const Collider square(Polygon{{{-1.0, -1.0}, {0.0, -1.0}, {0.0, 0.0}, {-1.0, 0.0}}});
  const Vec2 point(1e-5, -2e-4), left(-3.0, 3.0);
  const Collider wedge(Polygon{{point, {3.0, 2.9}, left}});
  const Vec2 outward = -perpendicular(point - left).normalized();
  const Manifold m = collide(square, wedge, at(0.0, 0.0), kMargin);
  ASSERT_EQ(m.count, 1);
  EXPECT_NEAR(m.points[0].gap, -outward.dot(point), 1e-12);
  EXPECT_NEAR((m.normal + outward).norm(), 0.0, 1e-12);
}

/// The corner of a leaning box has sunk into the corner of another by half a millimetre: it is
/// pushed up or aside, wherever exactly it is.
TEST(Collide, CornersThatOverlapByAHairAreNotPulledThrough) {
  const Collider upper(Polygon{{{1.000458014, 0.590663081},
                                {1.100087956, 0.599258115},
                                {1.057112789, 1.097407826},
                                {0.957482846, 1.088812793}}});
  const Collider lower(Polygon{{{1.100188275, 0.099759015},
                                {1.200188272, 0.099784021},
                                {1.200063239, 0.599784006},
                                {1.100063242, 0.599758999}}});
  for (const double aside : {-1e-5, 0.0, 1e-5, 1.4e-5, 1.6e-5, 2e-5, 2.4e-5}) {
    for (const double down : {-1e-5, -1e-6, 0.0, 1e-6, 1e-5}) {
      const Manifold m = collide(upper, lower, at(aside, down), kMargin);
      for (int i = 0; i < m.count; ++i) {
        EXPECT_LT(m.normal.y(), 0.1) << aside << ' ' << down << " gap " << m.points[0].gap;
      }
    }
  }
}

TEST(Collide, SeesACornerThatPointsAtAFace) {
  const double half_diagonal = std::numbers::sqrt2 / 2.0;
  const Manifold m = collide(box(10.0, 1.0), box(1.0, 1.0),
                             at(1.0, 0.5 + half_diagonal + 1e-3, std::numbers::pi / 4.0), kMargin);
  ASSERT_EQ(m.count, 1);
  EXPECT_EQ(m.normal, Vec2(0.0, 1.0));
  EXPECT_NEAR(m.points[0].gap, 1e-3, 1e-15);
  EXPECT_NEAR((m.points[0].position - Vec2(1.0, 0.5005)).norm(), 0.0, 1e-15);
}

TEST(Collide, SmallShapesSurvive) {
  const Manifold m = collide(box(0.004, 0.004), box(0.002, 0.002), at(0.0, 0.003), 1e-5);
  ASSERT_EQ(m.count, 2);
  EXPECT_NEAR(m.points[0].gap, 0.0, 1e-15);
  EXPECT_NEAR(m.points[0].position.x(), 0.001, 1e-15);
}

TEST(Collide, AShapeFarFromItsBodysOriginIsAsExactAsANearOne) {
  const Collider far_away(makeBox(2.0, 1.0, at(1e4, 0.0)));
  const Manifold m = collide(far_away, box(1.0, 1.0), at(1e4 + 0.25, 1.0 + 1e-6), kMargin);
  ASSERT_EQ(m.count, 2);
  EXPECT_NEAR(m.points[0].gap, 1e-6, 1e-14);
  EXPECT_NEAR(m.points[0].position.x(), 1e4 + 0.75, 1e-11);
}

TEST(Collide, SeesTwoDiscsAtOnePoint) {
  const Manifold m = collide(Collider(Circle{{0.0, 0.0}, 1.0}), Collider(Circle{{0.0, 0.0}, 0.5}),
                             at(1.501 * 0.6, 1.501 * 0.8), kMargin);
  ASSERT_EQ(m.count, 1);
  EXPECT_NEAR((m.normal - Vec2(0.6, 0.8)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(m.points[0].gap, 1e-3, 1e-15);
  EXPECT_NEAR((m.points[0].position - 1.0005 * Vec2(0.6, 0.8)).norm(), 0.0, 1e-15);
  EXPECT_EQ(m.points[0].feature, 0U);
}

TEST(Collide, ConcentricDiscsHaveAUnitNormal) {
  const Collider disc(Circle{{0.0, 0.0}, 1.0});
  const Manifold m = collide(disc, disc, at(0.0, 0.0), kMargin);
  ASSERT_EQ(m.count, 1);
  EXPECT_EQ(m.normal.norm(), 1.0);
  EXPECT_EQ(m.points[0].gap, -2.0);
}

TEST(Collide, SeesADiscOnAFaceFromBothSides) {
  const Collider floor = box(10.0, 1.0);
  const Collider disc(Circle{{0.25, 0.0}, 0.5});
  const Pose pose = at(1.0, 0.75 + 1e-3, std::numbers::pi / 2.0);  // centre at (1, 1.001)
  const Manifold m = collide(floor, disc, pose, kMargin);
  ASSERT_EQ(m.count, 1);
  EXPECT_EQ(m.normal, Vec2(0.0, 1.0));
  EXPECT_NEAR(m.points[0].gap, 1e-3, 1e-15);
  EXPECT_NEAR((m.points[0].position - Vec2(1.0, 0.5005)).norm(), 0.0, 1e-15);

  const Manifold back = collide(disc, floor, pose.inverse(), kMargin);
  ASSERT_EQ(back.count, 1);
  EXPECT_NEAR((pose.rotation * back.normal - Vec2(0.0, -1.0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((pose.exactly(back.points[0].position) - m.points[0].position).norm(), 0.0, 1e-15);
}

TEST(Collide, SeesADiscAtACorner) {
  const Manifold m = collide(box(2.0, 2.0), Collider(Circle{{0.0, 0.0}, 0.5}),
                             at(1.0 + 0.502 * 0.6, 1.0 + 0.502 * 0.8), kMargin);
  ASSERT_EQ(m.count, 1);
  EXPECT_NEAR((m.normal - Vec2(0.6, 0.8)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(m.points[0].gap, 0.002, 1e-15);
}

TEST(Collide, PushesADiscWhoseCenterIsInsideOutOfTheNearestFace) {
  const Manifold m =
      collide(box(2.0, 2.0), Collider(Circle{{0.0, 0.0}, 0.5}), at(0.7, 0.1), kMargin);
  ASSERT_EQ(m.count, 1);
  EXPECT_EQ(m.normal, Vec2(1.0, 0.0));
  EXPECT_NEAR(m.points[0].gap, -0.8, 1e-15);
}

TEST(Collide, ADiscCenteredOnACornerIsPushedOutward) {
  for (const double noise : {-1e-8, 0.0, 1e-8}) {
    const Manifold m = collide(box(2.0, 2.0), Collider(Circle{{0.0, 0.0}, 0.5}),
                               at(1.0 + noise, 1.0 + noise), kMargin);
    ASSERT_EQ(m.count, 1);
    EXPECT_GT(m.normal.sum(), 0.9);
    EXPECT_NEAR(m.points[0].gap, -0.5, 1e-7);
  }
}

}  // namespace
}  // namespace merge2d
