#include "render/camera.h"

#include <gtest/gtest.h>

#include "render/style.h"
#include "tests/render/samples.h"

namespace merge2d {
namespace {

constexpr PixelBox kPanel{10.0F, 20.0F, 400.0F, 200.0F};

TEST(View, YGoesUpInTheWorldAndDownInThePicture) {
  const View view({{1.0, 2.0}, 10.0}, kPanel);
  const Pixel center = view(Vec2(1.0, 2.0)), above = view(Vec2(1.0, 3.0));
  EXPECT_FLOAT_EQ(center.x, 210.0F);
  EXPECT_FLOAT_EQ(center.y, 120.0F);
  EXPECT_FLOAT_EQ(above.x, 210.0F);
  EXPECT_FLOAT_EQ(above.y, 100.0F);
  EXPECT_FLOAT_EQ(view(2.0), 40.0F);
}

TEST(View, KeepsItsPrecisionFarFromTheOrigin) {
  const View near({{0.0, 0.0}, 10.0}, kPanel), far({{1e6, 0.0}, 10.0}, kPanel);
  EXPECT_NEAR(near(Vec2(0.123, 0.0)).x, far(Vec2(1e6 + 0.123, 0.0)).x, 1e-3);
}

TEST(FitCamera, ShowsAllDynamicBodies) {
  const samples::Sample s = samples::tower(10, 32, 1);
  const Camera camera = fitCamera(s.snapshot, s.bodies, 16.0 / 9.0);
  const View view(camera, {0.0F, 0.0F, 1600.0F, 900.0F});
  for (const BodyState& body : s.snapshot.bodies) {
    EXPECT_TRUE(view.visible().contains(bodyBounds(s.bodies[index(body.id)], body.pose())));
  }
  EXPECT_LT(camera.height, 1.4 * 16.5) << "and wastes no room";
}

TEST(FitCamera, ShowsOfAHugeGroundOnlyWhatIsNear) {
  samples::Sample s;
  s.box({0.0, -500.0}, 4000.0, 1000.0, 0.0, Motion::Pinned);
  s.box({2.0, 0.5}, 1.0, 1.0);
  s.box({3.0, 1.5}, 1.0, 1.0);
  const Camera camera = fitCamera(s.snapshot, s.bodies, 1.5);
  EXPECT_LT(camera.height, 4.0);
  EXPECT_NEAR(camera.center.x(), 2.5, 0.1);
  EXPECT_LT(camera.center.y() - 0.5 * camera.height, -0.05) << "the ground's top is seen";
}

TEST(FitCamera, ShowsFixedBodiesOfTheSizeOfTheRest) {
  samples::Sample s;
  s.box({0.0, 0.0}, 1.0, 1.0);
  s.box({0.0, 3.0}, 1.5, 0.5, 0.0, Motion::Pinned);
  const View view(fitCamera(s.snapshot, s.bodies, 1.0), {0.0F, 0.0F, 100.0F, 100.0F});
  EXPECT_TRUE(view.visible().contains(Aabb{{-0.75, -0.5}, {0.75, 3.25}}));
}

TEST(FitCamera, DoesWithoutBodies) { EXPECT_GT(fitCamera(Coverage(), {}, 1.5).height, 0.0); }

TEST(FitCamera, WorksWithFixedBodiesAlone) {
  samples::Sample s;
  s.box({5.0, 5.0}, 2.0, 1.0, 0.0, Motion::Pinned);
  const Camera camera = fitCamera(s.snapshot, s.bodies, 1.0);
  EXPECT_NEAR(camera.center.x(), 5.0, 1e-9);
  EXPECT_NEAR(camera.height, 2.24, 0.01);
}

TEST(FitCamera, ShowsBodiesWhereverTheyGo) {
  samples::Sample s;
  s.box({0.0, 0.0}, 1.0, 1.0);
  Coverage seen(s.snapshot, s.bodies);
  s.snapshot.bodies[0].x = {6.0, -4.0};
  seen.add(s.snapshot, s.bodies);
  const View view(fitCamera(seen, s.bodies, 1.0), {0.0F, 0.0F, 100.0F, 100.0F});
  EXPECT_TRUE(view.visible().contains(Aabb{{-0.5, -4.5}, {6.5, 0.5}}));
}

TEST(FitCamera, DoesNotGoAfterWhatFliesAway) {
  samples::Sample s;
  s.box({0.0, 0.0}, 1.0, 1.0);
  Coverage seen(s.snapshot, s.bodies);
  s.snapshot.bodies[0].x = {0.0, 1e6};
  seen.add(s.snapshot, s.bodies);
  EXPECT_LT(fitCamera(seen, s.bodies, 1.0).height, 20.0);
}

TEST(FitCamera, LeavesAMargin) {
  samples::Sample s;
  s.box({0.0, 0.0}, 1.0, 1.0);
  EXPECT_NEAR(fitCamera(s.snapshot, s.bodies, 1.0, 0.25).height, 1.5, 1e-9);
}

TEST(CameraAt, MovesWithTheBodyThatItFollows) {
  samples::Sample s;
  s.box({2.0, 1.0}, 1.0, 1.0);
  Scene scene;
  scene.follow = 0;
  FrameStyle style;
  adaptToScene(style, scene, s.snapshot, s.bodies);
  EXPECT_EQ(cameraAt(style, s.snapshot).center, Vec2(2.0, 1.0));
  s.snapshot.bodies[0].x = {7.0, 3.0};
  EXPECT_EQ(cameraAt(style, s.snapshot).center, Vec2(7.0, 3.0));
}

TEST(RoundLength, IsOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(roundLength(1.0), 1.0);
  EXPECT_DOUBLE_EQ(roundLength(3.9), 2.0);
  EXPECT_DOUBLE_EQ(roundLength(9.0), 5.0);
  EXPECT_NEAR(roundLength(0.07), 0.05, 1e-12);
  EXPECT_DOUBLE_EQ(roundLength(4000.0), 2000.0);
}

TEST(LengthLabel, UsesTheUnitThatFits) {
  EXPECT_EQ(lengthLabel(5.0), "5 m");
  EXPECT_EQ(lengthLabel(0.2), "20 cm");
  EXPECT_EQ(lengthLabel(0.005), "5 mm");
  EXPECT_EQ(lengthLabel(2000.0), "2 km");
}

}  // namespace
}  // namespace merge2d
