/// Newton's law of restitution: h₁ = e² h₀.

#include <gtest/gtest.h>

#include "tests/support/modes_and_steps.h"

namespace merge2d {
namespace {

/// The heights [m] that the lowest point of a body reaches between its bounces, dropped from
/// `height`.
std::vector<double> bounces(Mode mode, double h, BodyDesc body, double height, double restitution,
                            std::size_t n) {
  Scene scene = onGround();
  scene.step = h;
  const double low = body.at.y();
  body.at.y() += height;
  body.restitution = restitution;
  add(scene, body);
  World world(scene, inMode(mode));
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

/// From any height, as the bounce has its own time within the step. The highest point between two
/// steps is up to g h² / 8 above that at one of them; the rest is rounding and the skin of
/// contacts.
TEST(Restitution, ABodyRisesToESquaredOfTheHeightItFellFrom) {
  for (const double e : {0.3, 0.5, 0.8, 1.0}) {
    for (const double height : {0.5, 1.47, 1.5, 1.53, 3.0, 10.0}) {
      for (const BodyDesc& body : {disc(0.5, {0, 0.5}), box(1, 1, {0, 0.5})}) {
        inEachModeAndStep([&](Mode mode, double h) {
          const auto peaks = bounces(mode, h, body, height, e, 1);
          ASSERT_EQ(peaks.size(), 1u);
          const double exact = e * e * height, fall = 0.5 * kGravity * h * h;
          EXPECT_NEAR(peaks[0], exact, fall + 0.01 * exact) << "e = " << e << ", " << height;
        });
      }
    }
  }
}

TEST(Restitution, WithoutItABodyStaysOnTheFloor) {
  for (const BodyDesc& body : {disc(0.5, {0, 0.5}), box(1, 1, {0, 0.5})}) {
    Scene scene = onGround();
    add(scene, body);
    scene.bodies[1].at.y() += 1.5;
    inEachModeAndStep([&](Mode mode, double h) {
      scene.step = h;
      World world(scene, inMode(mode));
      runSeconds(world, 0.6);
      double highest = 0.0;
      while (world.time() < 1.6) {
        world.step();
        highest = std::max(highest, see(world, BodyId{1}).x.y() - 0.5);
      }
      EXPECT_LT(highest, 1e-4);  // the skin of contacts
    });
  }
}

TEST(Restitution, AFullyElasticBodyKeepsItsHeight) {
  for (const BodyDesc& body : {disc(0.5, {0, 0.5}), box(1, 1, {0, 0.5})}) {
    inEachModeAndStep([&](Mode mode, double h) {
      const auto peaks = bounces(mode, h, body, 1.5, 1.0, 5);
      ASSERT_EQ(peaks.size(), 5u);
      for (const double peak : peaks) EXPECT_NEAR(peak, 1.5, kGravity * h * h / 8.0 + 0.002 * 1.5);
    });
  }
}

TEST(Restitution, TwoBodiesBounceWithTheLargerOfTheirCoefficients) {
  Scene scene = onGround();
  scene.bodies[0].restitution = 0.5;
  add(scene, disc(0.5, {0, 2.0}));
  inEachModeAndStep([&](Mode mode, double h) {
    scene.step = h;
    World world(scene, inMode(mode));
    double highest = 0.0;
    runSeconds(world, 0.6);
    while (world.time() < 1.2) {
      world.step();
      highest = std::max(highest, see(world, BodyId{1}).x.y() - 0.5);
    }
    EXPECT_NEAR(highest, 0.25 * 1.5, kGravity * h * h / 8.0 + 0.005);
  });
}

TEST(Restitution, ASlowApproachDoesNotBounce) {
  Scene scene = onGround();
  add(scene, disc(0.5, {0, 0.51}));  // meets the floor at 0.44 m/s, below the threshold
  scene.bodies[1].restitution = 1.0;
  inEachModeAndStep([&](Mode mode, double h) {
    scene.step = h;
    World world(scene, inMode(mode));
    runSeconds(world, 0.08);
    while (world.time() < 0.6) {
      world.step();
      ASSERT_LT(see(world, BodyId{1}).x.y(), 0.5 + 1e-4);
    }
  });
}

}  // namespace
}  // namespace merge2d
