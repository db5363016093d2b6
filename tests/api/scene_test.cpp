/// Scenes of the public interface.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <merge2d/merge2d.h>

#include <cmath>

#include "api_testing.h"

namespace {

using merge2d::Scene;
using merge2d::Shape;
using merge2d::World;
using merge2d::testing_api::refusal;
using merge2d::testing_api::towerOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(PublicScene, NamesTheFaultOfADescription) {
  Scene scene;
  EXPECT_THAT(refusal([&] { scene.add(merge2d::BodyDef{}); }), HasSubstr("shape"));
  EXPECT_THAT(refusal([&] { scene.add({.shapes = {Shape::circle(-1.0)}}); }), HasSubstr("radius"));
  EXPECT_THAT(refusal([&] { scene.add({.shapes = {Shape::circle(1.0)}, .mass = -1.0}); }),
              HasSubstr("mass"));
  EXPECT_THAT(refusal([&] {
                scene.add({.shapes = {Shape::polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}})}});
              }),
              HasSubstr("cross"));
  EXPECT_EQ(scene.bodyCount(), 0U);
  auto spring = merge2d::springDef();
  spring.body = 3;
  EXPECT_THAT(refusal([&] { scene.add(spring); }), HasSubstr("no body 3"));
}

TEST(PublicScene, AScriptedBodyNeedsAScript) {
  Scene scene;
  merge2d::BodyDef lift{.motion = merge2d::Motion::Scripted, .shapes = {Shape::box(1.0, 1.0)}};
  EXPECT_THAT(refusal([&] { scene.add(lift); }), HasSubstr("needs a script"));
  lift.script.kind = M2_KEYFRAMES;
  EXPECT_THAT(refusal([&] { scene.add(lift); }), HasSubstr("at least one key frame"));
  lift.script.kind = M2_STEADY;
  lift.script.velocity = {0.0, 1.0};
  EXPECT_EQ(scene.add(lift), 0U);
}

TEST(PublicScene, FindsABodyByItsName) {
  const Scene scene = Scene::load("books");
  const merge2d::Body diary = scene.find("diary");
  EXPECT_EQ(World(scene).find("diary"), diary);
  EXPECT_THAT(refusal([&] { scene.find("dairy"); }), HasSubstr("did you mean 'diary'"));
}

TEST(PublicScene, WarnsOfTwoRulesWhileItHasThem) {
  Scene scene;
  EXPECT_EQ(scene.warnings(), "");
  scene.set("merging.rule", "paper");
  EXPECT_THAT(scene.warnings(), HasSubstr("one cuts the welds of the other"));
  scene.set("unmerging.rule", "paper");
  EXPECT_EQ(scene.warnings(), "");
}

TEST(PublicScene, RefusesAValueInWordsOfALibrary) {
  Scene scene;
  EXPECT_THAT(refusal([&] { scene.set("step", 0.0); }), StartsWith("step=0: 'step'"));
  EXPECT_THAT(refusal([] { Scene::load("books", {"gravity=3"}); }), StartsWith("gravity=3: "));
}

TEST(PublicScene, APolygonNeedNotBeConvexNorCounterClockwise) {
  Scene scene;
  // An L of three unit squares, clockwise.
  scene.add({.shapes = {Shape::polygon({{0, 0}, {0, 2}, {1, 2}, {1, 1}, {2, 1}, {2, 0}})}});
  World world(scene);
  EXPECT_NEAR(world.info(0).mass, 3.0, 1e-9);
  EXPECT_GE(world.pieces(0).size(), 2U);
}

TEST(PublicScene, LoadsWithChangesAndWritesItselfDown) {
  const Scene scene = Scene::load("books", {"merging.velocity=0.03", "step=0.005"});
  EXPECT_EQ(scene.get("merging.velocity"), "0.03");
  const Scene again = Scene::parse(scene.toToml());
  EXPECT_EQ(again.get("step"), "0.005");
  EXPECT_EQ(again.bodyCount(), scene.bodyCount());
  EXPECT_THAT(refusal([] { Scene::load("bokos"); }), HasSubstr("did you mean 'books'"));
  EXPECT_THAT(refusal([] { Scene::parse("[[body]]\nbx = [1, 1]\n", "mine.toml"); }),
              HasSubstr("mine.toml:2:1"));
}

TEST(PublicScene, LivesOnItsOwn) {
  Scene scene = towerOf(1);
  World world(scene);
  scene = Scene();
  world.step(10);
  EXPECT_EQ(world.bodyCount(), 2U);
  EXPECT_EQ(scene.bodyCount(), 0U);
}

TEST(PublicScene, VersionsOfHeaderAndLibraryAgree) {
  EXPECT_EQ(merge2d::version(), std::to_string(M2_VERSION_MAJOR) + "." +
                                    std::to_string(M2_VERSION_MINOR) + "." +
                                    std::to_string(M2_VERSION_PATCH));
}

TEST(PublicScene, EmitsBodiesWhileItRuns) {
  Scene scene;
  scene.addEmitter({.name = "drop", .position = {0.0, 5.0}, .shapes = {Shape::circle(0.1)}}, 0.1,
                   3);
  World world(scene);
  ASSERT_EQ(world.bodyCount(), 3U);
  world.step(15);
  EXPECT_TRUE(world.info(1).present);
  EXPECT_FALSE(world.info(2).present);
  EXPECT_STREQ(world.info(2).name, "drop[2]");
  scene.addEmitter({.shapes = {Shape::circle(0.1)}}, -1.0, 3);
  EXPECT_THAT(refusal([&] { World refused(scene); }), HasSubstr("every"));
}

}  // namespace
