/// Drawn scenes: what a picture means.

#include <fmt/format.h>

#include "tests/src2d/scene/drawing_testing.h"

namespace merge2d {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// The smallest box around a body, in the world.
std::pair<Vec2, Vec2> extent(const BodyDesc& body) {
  Vec2 lower = Vec2::Constant(1e9);
  Vec2 upper = Vec2::Constant(-1e9);
  for (const ConvexShape& shape : body.shapes) {
    for (const Vec2& v : std::get<Polygon>(shape).vertices) {
      lower = lower.cwiseMin(body.at + v);
      upper = upper.cwiseMax(body.at + v);
    }
  }
  return {lower, upper};
}

TEST(Drawing, APatchIsABodyWithYUpAndATenthOfAMetreAPixel) {
  const Scene scene = draw({"     ",  //
                            " ### ",  //
                            "     ",  //
                            "     "});
  ASSERT_EQ(scene.bodies.size(), 1u);
  const BodyDesc& body = scene.bodies[0];
  EXPECT_EQ(body.name, "body1");
  EXPECT_EQ(body.motion, Motion::Dynamic);
  ASSERT_EQ(body.shapes.size(), 1u);
  const auto [lower, upper] = extent(body);
  EXPECT_NEAR((lower - Vec2(0.1, 0.2)).norm(), 0, 1e-12);
  EXPECT_NEAR((upper - Vec2(0.4, 0.3)).norm(), 0, 1e-12);
  EXPECT_DOUBLE_EQ(body.mass.value(), 3 * 0.01) << "black weighs 1 kg per square metre";
  EXPECT_EQ(scene.name, "drawn");
  EXPECT_EQ(scene.duration, 20);
}

TEST(Drawing, TheCameraSeesThePicture) {
  const Scene scene = draw({"#   ", "    "});
  ASSERT_TRUE(scene.camera.has_value());
  EXPECT_NEAR(scene.camera->center.x(), 0.2, 1e-12);
  EXPECT_NEAR(scene.camera->center.y(), 0.1, 1e-12);
  EXPECT_NEAR(scene.camera->height, 0.4 * 9 / 16 * 1.05, 1e-9);
}

TEST(Drawing, PixelsThatTouchAtACornerAreOneBody) {
  const Scene scene = draw({"#   #",  //
                            " #   ",  //
                            "  #  "});
  ASSERT_EQ(scene.bodies.size(), 2u);
  EXPECT_EQ(scene.bodies[0].shapes.size(), 3u);
  EXPECT_EQ(scene.bodies[1].shapes.size(), 1u);
}

TEST(Drawing, BodiesAreNumberedFromTheTopLeftByTheirRole) {
  const Scene scene = draw({"  #  b",  //
                            "b     ",  //
                            "#    #"});
  std::vector<std::string> names;
  for (const BodyDesc& body : scene.bodies) names.push_back(body.name);
  EXPECT_THAT(names, ElementsAre("body1", "pinned1", "body2", "body3"));
}

TEST(Drawing, ABodyIsPinnedWhenAllOfItIsBlue) {
  const Scene scene = draw({"bb bb",  //
                            "bb b#"});
  EXPECT_EQ(scene.bodies[0].motion, Motion::Pinned);
  EXPECT_EQ(scene.bodies[1].motion, Motion::Dynamic);
}

TEST(Drawing, AnyGreenPixelPinsForAWhile) {
  const Scene scene = draw({"#e# #"});
  EXPECT_EQ(scene.bodies[0].motion, Motion::Dynamic);
  EXPECT_EQ(scene.bodies[0].pinned_until, 2.0);
  EXPECT_EQ(scene.bodies[1].pinned_until, 0.0);
  EXPECT_EQ(draw({"#e# #"}, {{"drawing.pinned_until", "5"}}).bodies[0].pinned_until, 5.0);
}

TEST(Drawing, DarkerIsDenser) {
  const Scene scene = draw({"# g"});
  EXPECT_NEAR(scene.bodies[0].mass.value(), 0.01, 1e-9);
  EXPECT_NEAR(scene.bodies[1].mass.value(), 0.01 * (1 - 127.0 / 255), 1e-9);
}

TEST(Drawing, YellowJoinsWithoutMatter) {
  const Scene scene = draw({"#yy#"});
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[0].shapes.size(), 2u);
  EXPECT_NEAR(areaProperties(scene.bodies[0].shapes).area, 0.02, 1e-12);
  EXPECT_NEAR(scene.bodies[0].mass.value(), 0.02, 1e-12);
}

TEST(Drawing, BlueHeldTogetherByYellowIsPinned) {
  EXPECT_EQ(draw({"byb"}).bodies[0].motion, Motion::Pinned);
}

TEST(Drawing, YellowAloneIsLeftOut) {
  const Scene scene = draw({"yy #", "    ", "bbbb"});
  EXPECT_EQ(scene.bodies.size(), 2u);
  EXPECT_THAT(
      scene.warnings,
      ElementsAre(HasSubstr("the yellow patch at pixel (0, 0) joins nothing and is left out")));
}

TEST(Drawing, ARedPixelIsASpringToWhereItWasDrawn) {
  const Scene scene = draw({"     ",  //
                            " r## "});
  ASSERT_EQ(scene.springs.size(), 1u);
  const SpringDesc& spring = scene.springs[0];
  EXPECT_NEAR((spring.to - Vec2(0.15, 0.05)).norm(), 0, 1e-12);
  EXPECT_NEAR((scene.bodies[0].at + spring.anchor - spring.to).norm(), 0, 1e-12);
  EXPECT_EQ(spring.rest_length, 0);
  EXPECT_THAT(scene.magnets, IsEmpty());
}

TEST(Drawing, SpringsSagByAPixelUnderTheWeightOfTheirBody) {
  const Scene scene = draw({"r##r"});
  ASSERT_EQ(scene.springs.size(), 2u);
  const double mass = scene.bodies[0].mass.value();
  const double stiffness = scene.springs[0].stiffness + scene.springs[1].stiffness;
  EXPECT_NEAR(mass * 9.81 / stiffness, 0.1, 1e-6);
  const double damping = scene.springs[0].damping + scene.springs[1].damping;
  const double ratio = damping / (2 * std::sqrt(stiffness * mass));
  EXPECT_GT(ratio, 0.1);
  EXPECT_LT(ratio, 0.2);
}

TEST(Drawing, SpringsCanBeChosen) {
  const Scene scene = draw({"r##r"}, {{"drawing.stiffness", "7"}, {"drawing.damping", "3"}});
  EXPECT_EQ(scene.springs[0].stiffness, 7);
  EXPECT_EQ(scene.springs[0].damping, 3);
}

TEST(Drawing, AMagentaPixelIsASpringAndMakesAMagnet) {
  const Scene scene = draw({"#  #m"});
  EXPECT_EQ(scene.springs.size(), 1u);
  ASSERT_EQ(scene.magnets.size(), 1u);
  EXPECT_EQ(scene.magnets[0].body, 1u);
  EXPECT_EQ(scene.magnets[0].on[0].until, kForever);
  EXPECT_EQ(scene.bodies[1].name, "magnet1");
}

TEST(Drawing, TwoLoneCyanPixelsSpanTheGround) {
  const Scene scene = draw({" #    ",  //
                            "     c",  //
                            "c     "});
  ASSERT_EQ(scene.bodies.size(), 2u);
  const BodyDesc& ground = scene.bodies[0];
  EXPECT_EQ(ground.name, "ground");
  EXPECT_EQ(ground.motion, Motion::Pinned);
  EXPECT_NEAR(ground.angle, std::atan2(1, 5), 1e-12);
  // Both pixels' centres are on its upper side.
  const Pose pose = Pose::at(ground.at, ground.angle);
  const double top = std::get<Polygon>(ground.shapes[0]).vertices[2].y();
  EXPECT_NEAR(pose.toLocal({0.05, 0.05}).y(), top, 1e-9);
  EXPECT_NEAR(pose.toLocal({0.55, 0.15}).y(), top, 1e-9);
  EXPECT_GE(areaProperties(ground.shapes).area, 10.0);
}

TEST(Drawing, OtherCyanPixelsAreMatterWithAWarning) {
  const Scene scene = draw({"c  c  c  b"});
  EXPECT_EQ(scene.bodies.size(), 4u);
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("pixel (0, 0) is cyan, but the ground needs "
                                                    "exactly two lone cyan pixels")));
  EXPECT_EQ(draw({"c# c"}).bodies.size(), 2u);
}

TEST(Drawing, TransparentIsEmptyAndHalfTransparentIsPaler) {
  const Scene scene = draw({"t# h"});
  ASSERT_EQ(scene.bodies.size(), 2u);
  EXPECT_NEAR(scene.bodies[1].mass.value(), 0.01 * 128 / 255, 1e-9);
}

TEST(Drawing, AnEmptyPictureIsAnEmptyScene) {
  EXPECT_THAT(draw({"  "}).warnings, ElementsAre(HasSubstr("the scene has no bodies")));
}

/// Checks that a file shows one black body of 2 × 1 pixels and a pinned one of 1 × 1.
void expectTwoBodies(const std::string& png) {
  const TemporaryFile file("kind.png", png);
  const Scene scene = loadScene(file.path().string());
  ASSERT_EQ(scene.bodies.size(), 2u);
  EXPECT_NEAR(scene.bodies[0].mass.value(), 0.02, 1e-9);
  EXPECT_EQ(scene.bodies[1].motion, Motion::Pinned);
  EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST(Drawing, InterlacedAndPalettePicturesAreRead) {
  const Rows rows = {"##  ", "   b"};
  expectTwoBodies(encode(rows));
  expectTwoBodies(encode(rows, true));
  const PngKind palette{
      .depth = 2, .color = 3, .palette = std::string("\xff\xff\xff\0\0\0\0\0\xff", 9)};
  const auto entry = [&](std::uint32_t x, std::uint32_t y) {
    return bits(rows[y][x] == '#' ? 1 : rows[y][x] == 'b' ? 2 : 0, 2);
  };
  expectTwoBodies(encodePng(4, 2, palette, entry));
  const auto deep = [&](std::uint32_t x, std::uint32_t y) {
    const Image::Pixel p = kColors.at(rows[y][x]);
    return bits(p.r * 257u, 16) + bits(p.g * 257u, 16) + bits(p.b * 257u, 16);
  };
  expectTwoBodies(encodePng(4, 2, {.depth = 16, .color = 2}, deep));
}

TEST(Drawing, GreyPicturesOfAnyDepthAreRead) {
  for (const int depth : {1, 2, 4, 8, 16}) {
    const auto checker = [depth](std::uint32_t x, std::uint32_t) {
      return std::string(static_cast<std::size_t>(depth), x % 2 == 0 ? '1' : '0');
    };
    const TemporaryFile file("grey.png", encodePng(5, 1, {.depth = depth, .color = 0}, checker));
    EXPECT_EQ(loadScene(file.path().string()).bodies.size(), 2u) << depth << " bits";
  }
}

/// A sample of 16 bits that repeats its 8 means the same grey, and so the same density.
TEST(Drawing, TheDepthOfASampleChangesNoDensity) {
  const auto densityOf = [](int depth, unsigned value) {
    const auto body = [&](std::uint32_t x, std::uint32_t) {
      const unsigned grey = x == 1 ? value : 255;
      return depth == 8 ? bits(grey, 8) : bits(257 * grey, 16);
    };
    const TemporaryFile file("grey.png", encodePng(3, 1, {.depth = depth, .color = 0}, body));
    return loadScene(file.path().string()).bodies.at(0).density;
  };
  for (const unsigned value : {0u, 64u, 128u, 200u, 235u}) {
    EXPECT_EQ(densityOf(16, value), densityOf(8, value)) << value;
  }
}

TEST(Drawing, OverridesReachTheDrawnBodies) {
  const Scene scene = draw({"# b"}, {{"drawing.pixel", "0.5"},
                                     {"material.density", "2"},
                                     {"material.friction", "0.1"},
                                     {"body.body1.restitution", "0.5"},
                                     {"duration", "3"}});
  EXPECT_DOUBLE_EQ(scene.bodies[0].mass.value(), 0.5);
  EXPECT_EQ(scene.bodies[0].friction, 0.1);
  EXPECT_EQ(scene.bodies[0].restitution, 0.5);
  EXPECT_EQ(scene.duration, 3);
}

TEST(Drawing, ItsTextMeansTheSame) {
  const Scene scene = draw({"  ###   m#  ",  //
                            "  #   e     ",  //
                            " r##     bb ",  //
                            "            ",  //
                            "c          c"});
  const Scene again = parseScene(toToml(scene), "drawn.toml");
  EXPECT_EQ(toToml(again), toToml(scene));
  EXPECT_EQ(again.bodies.size(), 5u);
  EXPECT_EQ(again.springs.size(), 2u);
}

}  // namespace
}  // namespace merge2d
