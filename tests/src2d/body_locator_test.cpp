/// Which bodies are where, compared with sampled points.

#include "src2d/body_locator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace merge2d {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Discs, boxes and bodies of two pieces, turned at random, around `center`.
Scene scattered(const Vec2& center) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-10.0, 10.0), size(0.2, 1.5), angle(-3.0, 3.0);
  Scene scene;
  for (int i = 0; i < 60; ++i) {
    BodyDesc body;
    body.at = center + Vec2(place(random), place(random));
    body.angle = angle(random);
    body.shapes.push_back(i % 2 == 0 ? ConvexShape(Circle{{0.3, 0.0}, size(random)})
                                     : makeBox(size(random), size(random)));
    if (i % 3 == 0) body.shapes.push_back(makeBox(0.5, 2.0, Pose::at({1.0, 0.5}, 0.4)));
    scene.bodies.push_back(body);
  }
  return scene;
}

TEST(BodyLocator, ARayEndsWhereItsPointsBeginToBePartsOfTheBody) {
  for (const Vec2& center : {Vec2(0.0, 0.0), Vec2(5000.0, -3000.0)}) {
    const World world(scattered(center));
    BodyLocator locator;
    locator.update(world);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-14.0, 14.0);
    int hits = 0;
    for (int i = 0; i < 300; ++i) {
      const Vec2 from = center + Vec2(place(random), place(random));
      const Vec2 to = center + Vec2(place(random), place(random));
      const auto hit = locator.castRay(from, to);
      const double end = hit ? hit->fraction : 1.0;
      for (int k = 0; k < 50; ++k) {
        const Vec2 before = from + (end - 1e-6) * k / 50.0 * (to - from);
        if (end > 1e-6) {
          ASSERT_THAT(locator.at(before), IsEmpty()) << "ray " << i;
        }
      }
      if (!hit) continue;
      ++hits;
      const auto inside = locator.at(from + (end + 1e-7) * (to - from));
      ASSERT_TRUE(std::find(inside.begin(), inside.end(), hit->body) != inside.end() ||
                  std::abs(hit->normal.dot((to - from).normalized())) < 1e-2)
          << "ray " << i << " touches no body there";
      if (end > 0.0) {
        ASSERT_LE(hit->normal.dot(to - from), 0.0) << "ray " << i;
        ASSERT_NEAR(hit->normal.norm(), 1.0, 1e-9);
      }
    }
    EXPECT_GT(hits, 200);
  }
}

TEST(BodyLocator, AShapeTouchesTheBodiesThatHoldOneOfItsPoints) {
  const World world(scattered(Vec2::Zero()));
  BodyLocator locator;
  locator.update(world);
  std::mt19937 random(13);
  std::uniform_real_distribution<double> place(-10.0, 10.0);
  for (int i = 0; i < 100; ++i) {
    const Pose pose = Pose::at({place(random), place(random)}, place(random));
    const auto touched = locator.touching({makeBox(2.0, 1.0)}, pose);
    for (double x = -0.99; x < 1.0; x += 0.11) {
      for (double y = -0.49; y < 0.5; y += 0.07) {
        for (const BodyId body : locator.at(pose * Vec2(x, y))) {
          ASSERT_TRUE(std::binary_search(touched.begin(), touched.end(), body)) << "box " << i;
        }
      }
    }
  }
}

TEST(BodyLocator, SeesBodiesThatHaveComeAndNotThoseThatHaveGone) {
  Scene scene;
  scene.bodies.emplace_back().shapes = {Circle{}};
  World world(scene);
  BodyDesc more = scene.bodies.front();
  more.at = {5.0, 0.0};
  world.addBody(more);
  world.removeBody(BodyId{0});
  BodyLocator locator;
  locator.update(world);
  EXPECT_THAT(locator.at({0.0, 0.0}), IsEmpty());
  EXPECT_FALSE(locator.pose(BodyId{0}));
  EXPECT_THAT(locator.at({5.0, 0.0}), ElementsAre(BodyId{1}));
}

}  // namespace
}  // namespace merge2d
