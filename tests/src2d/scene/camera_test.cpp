/// [camera] and the materials' keys, there and back.

#include "src2d/scene/load.h"
#include "tests/src2d/scene/scene_testing.h"

namespace merge2d {
namespace {

using testing::HasSubstr;

const std::string kBall = "format = 1\n[[body]]\nname = \"ball\"\nat = [3, 4]\ncircle = 1\n";

Scene with(const std::string& more) { return parseScene(kBall + more, "test.toml"); }
Scene again(const Scene& scene) { return parseScene(toToml(scene), "again.toml"); }

TEST(CameraKeys, AreKeptWhenASceneIsWritten) {
  const Scene scene = again(with("[camera]\nfollow = \"ball\"\nheight = 5\nmargin = 0.5\n"));
  ASSERT_TRUE(scene.follow);
  EXPECT_EQ(scene.bodies[*scene.follow].name, "ball");
  ASSERT_TRUE(scene.camera);
  EXPECT_EQ(scene.camera->height, 5.0);
  EXPECT_EQ(scene.camera->center, Vec2(3, 4)) << "where the body is";
  EXPECT_EQ(scene.margin, 0.5);
}

TEST(CameraKeys, ACameraThatFollowsNeedsNoPlace) {
  const Scene scene = again(with("[camera]\nfollow = \"ball\"\n"));
  EXPECT_TRUE(scene.follow);
  EXPECT_FALSE(scene.camera);
}

TEST(CameraKeys, OnlyABodyThatThereIsCanBeFollowed) {
  EXPECT_THAT(errorOf(kBall + "[camera]\nfollow = \"bal\"\n"), HasSubstr("did you mean 'ball'"));
}

TEST(MaterialKeys, AreKeptWhenASceneIsWritten) {
  const std::string belt =
      "[material]\nrolling = 0.03\n[[body]]\nmotion = \"pinned\"\nbox = [1, 1]\n"
      "surface_velocity = -2.5\nrolling = 0.01\n";
  const Scene scene = again(with(belt));
  EXPECT_EQ(scene.bodies[0].rolling, 0.03);
  EXPECT_EQ(scene.bodies[0].surface_velocity, 0.0);
  EXPECT_EQ(scene.bodies[1].rolling, 0.01);
  EXPECT_EQ(scene.bodies[1].surface_velocity, -2.5);
}

}  // namespace
}  // namespace merge2d
