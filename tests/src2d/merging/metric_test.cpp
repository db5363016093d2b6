#include "src2d/merging/metric.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/random.h"

namespace merge2d {
namespace {

VelocityField anyField() { return {anyVec(5.0), anyVec(2.0), uniform(-3.0, 3.0)}; }
OrientedBox anyBox() {
  return {Pose::at(anyVec(5.0), uniform(-3.0, 3.0)), {uniform(0.1, 3.0), uniform(0.1, 3.0)}};
}

const VelocityField kAtRest;

TEST(Metric, EndsOfASeeSawMoveWithOmegaTimesHalfItsLength) {
  const double length = 6.0, omega = 0.25;
  const OrientedBox beam{Pose::at({3.0, 4.0}, 0.1), {0.5 * length, 0.0}};
  const VelocityField turning{beam.frame.position, Vec2::Zero(), omega};
  EXPECT_NEAR(fastestCorner(beam, turning, kAtRest), omega * length / 2.0, 1e-15);
}

TEST(Metric, SeesASlowSeeSawThatIsStillAtItsPivot) {  // Figure 2
  const double threshold = 1e-2;
  const OrientedBox beam{Pose::at({0.0, 1.0}, 0.0), {3.0, 0.1}};
  const VelocityField turning{beam.frame.position, Vec2::Zero(), 0.01};
  EXPECT_LT((turning.at(beam.frame.position) - kAtRest.at(beam.frame.position)).norm(), threshold);
  EXPECT_GT(fastestCorner(beam, turning, kAtRest), threshold);
}

TEST(Metric, OfATranslationIsItsSpeed) {
  const OrientedBox box{Pose::at({1.0, 2.0}, 0.7), {2.0, 1.0}};
  const VelocityField moving{{5.0, 5.0}, {3.0, -4.0}, 0.0};
  EXPECT_NEAR(fastestCorner(box, moving, kAtRest), 5.0, 1e-15);
}

RC_GTEST_PROP(Metric, DoesNotDependOnWhereInTheWorldThePairIs, ()) {
  const Vec2 far(10'000.0, -7'000.0);
  OrientedBox box = anyBox();
  VelocityField a = anyField(), b = anyField();
  const double here = fastestCorner(box, a, b);
  box.frame.position += far;
  a.x += far;
  b.x += far;
  RC_ASSERT(std::abs(fastestCorner(box, a, b) - here) < 1e-10);
}

RC_GTEST_PROP(Metric, DoesNotDependOnACommonRigidMotion, ()) {
  const OrientedBox box = anyBox();
  VelocityField a = anyField(), b = anyField();
  const double still = fastestCorner(box, a, b);
  const VelocityField common = anyField();
  a.v += common.at(a.x);
  b.v += common.at(b.x);
  a.omega += common.omega;
  b.omega += common.omega;
  RC_ASSERT(std::abs(fastestCorner(box, a, b) - still) < 1e-12);
}

RC_GTEST_PROP(Metric, DoesNotDependOnTheOrderOfTheTwo, ()) {
  const OrientedBox box = anyBox();
  const VelocityField a = anyField(), b = anyField();
  RC_ASSERT(fastestCorner(box, a, b) == fastestCorner(box, b, a));
}

RC_GTEST_PROP(Metric, BoundsTheSpeedOfEveryPointOfTheBox, ()) {
  const OrientedBox box = anyBox();
  const VelocityField a = anyField(), b = anyField();
  const Vec2 p = box.frame * Vec2(box.half.x() * uniform(-1, 1), box.half.y() * uniform(-1, 1));
  RC_ASSERT((a.at(p) - b.at(p)).norm() <= fastestCorner(box, a, b) + 1e-12);
}

}  // namespace
}  // namespace merge2d
