/// Newton's law of restitution: h₁ = e² h₀.

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace merge2d {
namespace {

/// The heights [m] that the lowest point of a body reaches between its bounces, dropped from
/// `height`.
std::vector<double> bounces(BodyDesc body, double height, double restitution, std::size_t n) {
  Scene scene = onGround();
  const double low = body.at.y();
  body.at.y() += height;
  body.restitution = restitution;
  add(scene, body);
  World world = reference(scene);
  std::vector<double> peaks;
  double rising = -1.0;
  while (peaks.size() < n && world.time() < 20.0) {
    world.step();
    const BodyState seen = see(world, BodyId{1});
    if (rising > 0.0 && seen.v.y() <= 0.0) peaks.push_back(seen.x.y() - low);
    rising = seen.v.y();
  }
  return peaks;
}

/// The softness of the contact and the discrete fall cost up to 7% of the height.
TEST(Restitution, ABodyRisesToESquaredOfTheHeightItFellFrom) {
  for (const double height : {1.5, 1.47, 1.53, 1.6}) {
    for (const BodyDesc& body : {disc(0.5, {0, 0.5}), box(1, 1, {0, 0.5})}) {
      const auto peaks = bounces(body, height, 0.5, 1);
      ASSERT_EQ(peaks.size(), 1u);
      EXPECT_GT(peaks[0], 0.93 * 0.25 * height) << "from " << height;
      EXPECT_LT(peaks[0], 1.01 * 0.25 * height) << "from " << height;
    }
  }
}

/// Whatever the restitution and the height: the bounce falls within a step, not at its end, and is
/// misplaced by up to what the body falls in half of it.
TEST(Restitution, TheHeightIsRightToAPartOfAStep) {
  for (const double e : {0.3, 0.5, 0.8}) {
    for (const double height : {0.5, 1.0, 1.5, 3.0, 10.0}) {
      for (const BodyDesc& body : {disc(0.5, {0, 0.5}), box(1, 1, {0, 0.5})}) {
        const auto peaks = bounces(body, height, e, 1);
        ASSERT_EQ(peaks.size(), 1u);
        const double exact = e * e * height, way = 0.01 * std::sqrt(2.0 * kGravity * height);
        EXPECT_NEAR(peaks[0], exact, 0.5 * way + 0.01 * exact) << "e = " << e << " from " << height;
      }
    }
  }
}

TEST(Restitution, WithoutItABodyStaysOnTheFloor) {
  for (const BodyDesc& body : {disc(0.5, {0, 0.5}), box(1, 1, {0, 0.5})}) {
    Scene scene = onGround();
    add(scene, body);
    scene.bodies[1].at.y() += 1.5;
    World world = reference(scene);
    runSeconds(world, 0.6);
    double highest = 0.0;
    for (int i = 0; i < 100; ++i) {
      world.step();
      highest = std::max(highest, see(world, BodyId{1}).x.y() - 0.5);
    }
    EXPECT_LT(highest, 1e-4);
  }
}

/// The discrete fall alone costs a few percent of the height at each bounce.
TEST(Restitution, AFullyElasticBodyKeepsItsHeight) {
  for (const BodyDesc& body : {disc(0.5, {0, 0.5}), box(1, 1, {0, 0.5})}) {
    const auto peaks = bounces(body, 1.5, 1.0, 5);
    ASSERT_EQ(peaks.size(), 5u);
    double before = 1.5;
    for (const double peak : peaks) {
      EXPECT_GT(peak, 0.95 * before);
      EXPECT_LT(peak, 1.01 * before);
      before = peak;
    }
  }
}

TEST(Restitution, TwoBodiesBounceWithTheLargerOfTheirCoefficients) {
  Scene scene = onGround();
  scene.bodies[0].restitution = 0.5;
  add(scene, disc(0.5, {0, 2.0}));
  World world = reference(scene);
  double highest = 0.0;
  runSeconds(world, 0.6);
  for (int i = 0; i < 60; ++i) {
    world.step();
    highest = std::max(highest, see(world, BodyId{1}).x.y() - 0.5);
  }
  EXPECT_NEAR(highest, 0.25 * 1.5, 0.06);
}

TEST(Restitution, ASlowApproachDoesNotBounce) {
  Scene scene = onGround();
  add(scene, disc(0.5, {0, 0.51}));  // meets the floor at 0.44 m/s, below the threshold
  scene.bodies[1].restitution = 1.0;
  World world = reference(scene);
  runSteps(world, 8);
  for (int i = 0; i < 50; ++i) {
    world.step();
    ASSERT_LT(see(world, BodyId{1}).x.y(), 0.5 + 1e-4);
  }
}

}  // namespace
}  // namespace merge2d
