#include "render/canvas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "render/painter.h"
#include "src2d/core/error.h"

namespace merge2d {
namespace {

constexpr Color kWhite = rgb(0xffffff), kBlack = rgb(0x000000);
constexpr Color kRed = rgb(0xff0000), kBlue = rgb(0x0000ff);

/// Draws on a small black canvas.
class CanvasTest : public testing::Test {
 protected:
  CanvasTest() {
    drawing.background = kBlack;
    painter.beginLayer();
  }
  Picture draw() { return canvas.draw(drawing); }

  /// How many pixels white covers on black.
  static double coveredArea(const Picture& picture) {
    double sum = 0.0;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) sum += picture.at(x, y).r / 255.0;
    }
    return sum;
  }

  Canvas canvas{120, 80};
  Drawing drawing;
  Painter painter{drawing, canvas.text()};
};

TEST_F(CanvasTest, FillsTheWholePictureWithTheBackground) {
  drawing.background = rgb(0x123456);
  const Picture picture = draw();
  EXPECT_EQ(picture.at(0, 0), rgb(0x123456));
  EXPECT_EQ(picture.at(119, 79), rgb(0x123456));
}

TEST_F(CanvasTest, LeavesATransparentBackgroundTransparent) {
  drawing.background = {};
  painter.disc({60.0F, 40.0F}, 20.0F, {.fill = kRed});
  const Picture picture = draw();
  EXPECT_EQ(picture.at(2, 2).a, 0);
  EXPECT_EQ(picture.at(60, 40), kRed);
  // On the edge the colour stays what it is; only its opacity goes down.
  for (int x = 35; x < 45; ++x) {
    const Color c = picture.at(x, 40);
    if (c.a > 8) {
      EXPECT_GE(c.r, 250) << "at " << x;
    }
  }
}

TEST_F(CanvasTest, ADiscCoversItsArea) {
  for (const float radius : {1.0F, 3.3F, 20.0F, 33.7F}) {
    drawing.layers.back().shapes.clear();
    painter.disc({60.3F, 40.7F}, radius, {.fill = kWhite});
    const double exact = std::numbers::pi * double{radius} * double{radius};
    EXPECT_NEAR(coveredArea(draw()), exact, 0.005 * exact + 0.3) << "radius " << radius;
  }
}

TEST_F(CanvasTest, AConvexPolygonCoversItsAreaInEitherOrientation) {
  std::vector<Pixel> octagon;
  for (int i = 0; i < 8; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 8.0 + 0.2;
    octagon.push_back({60.0F + 30.0F * static_cast<float>(std::cos(angle)),
                       40.0F + 30.0F * static_cast<float>(std::sin(angle))});
  }
  const double exact = 0.5 * 8.0 * 900.0 * std::sin(2.0 * std::numbers::pi / 8.0);
  painter.polygon(octagon, 0.0F, {.fill = kWhite});
  EXPECT_NEAR(coveredArea(draw()), exact, 0.005 * exact);
  drawing.layers.back().shapes.clear();
  std::reverse(octagon.begin(), octagon.end());
  painter.polygon(octagon, 0.0F, {.fill = kWhite});
  EXPECT_NEAR(coveredArea(draw()), exact, 0.005 * exact);
}

TEST_F(CanvasTest, APolygonAndABoxOfTheSameShapeLookTheSame) {
  const std::vector<Pixel> corners = {
      {20.5F, 10.25F}, {90.5F, 10.25F}, {90.5F, 60.0F}, {20.5F, 60.0F}};
  const Paint paint{.fill = kRed, .outline = kWhite, .line = 2.0F};
  painter.polygon(corners, 0.0F, paint);
  const Picture polygon = draw();
  drawing.layers.back().shapes.clear();
  painter.box({20.5F, 10.25F, 70.0F, 49.75F}, 0.0F, paint);
  const Picture box = draw();
  for (std::size_t i = 0; i < box.rgba.size(); ++i) {
    ASSERT_NEAR(int{box.rgba[i]}, int{polygon.rgba[i]}, 1) << "byte " << i;
  }
}

TEST_F(CanvasTest, EdgesOnPixelBordersAreSharp) {
  painter.box({20.0F, 10.0F, 30.0F, 20.0F}, 0.0F, {.fill = kWhite});
  const Picture picture = draw();
  EXPECT_EQ(picture.at(19, 15), kBlack);
  EXPECT_EQ(picture.at(20, 15), kWhite);
  EXPECT_EQ(picture.at(49, 29), kWhite);
  EXPECT_EQ(picture.at(50, 29), kBlack);
}

TEST_F(CanvasTest, AnEdgeInTheMiddleOfAPixelIsHalfCovered) {
  painter.box({20.5F, 10.0F, 30.0F, 20.0F}, 0.0F, {.fill = kWhite});
  const Picture picture = draw();
  EXPECT_NEAR(picture.at(20, 15).r, 128, 2);
  EXPECT_NEAR(picture.at(50, 15).r, 128, 2);
}

TEST_F(CanvasTest, TheOutlineLiesInsideOfTheBoundary) {
  painter.box({20.0F, 10.0F, 30.0F, 20.0F}, 0.0F, {.fill = kRed, .outline = kWhite, .line = 2.0F});
  const Picture picture = draw();
  EXPECT_EQ(picture.at(19, 20), kBlack);
  EXPECT_EQ(picture.at(20, 20), kWhite);
  EXPECT_EQ(picture.at(21, 20), kWhite);
  EXPECT_EQ(picture.at(22, 20), kRed);
}

TEST_F(CanvasTest, LaterShapesLieOverEarlierOnes) {
  painter.disc({60.0F, 40.0F}, 20.0F, {.fill = kRed});
  painter.box({50.0F, 30.0F, 20.0F, 20.0F}, 0.0F, {.fill = kBlue});
  painter.disc({60.0F, 40.0F}, 5.0F, {.fill = kWhite});
  const Picture picture = draw();
  EXPECT_EQ(picture.at(60, 24), kRed);
  EXPECT_EQ(picture.at(52, 32), kBlue);
  EXPECT_EQ(picture.at(60, 40), kWhite);
}

TEST_F(CanvasTest, HatchingCoversItsShareOfTheFill) {
  painter.box(
      {10.0F, 10.0F, 100.0F, 60.0F}, 0.0F,
      {.fill = kBlack, .hatch = {.color = kWhite, .stripes = {0.07F, 0.07F}, .width = 2.0F}});
  const double share = 2.0 * std::hypot(0.07, 0.07);
  EXPECT_NEAR(coveredArea(draw()), share * 6000.0, 0.05 * share * 6000.0);
}

TEST_F(CanvasTest, ALineHasItsWidth) {
  painter.line({20.0F, 20.0F}, {80.0F, 50.0F}, 3.0F, kWhite);
  const double exact = 3.0 * std::hypot(60.0, 30.0) + std::numbers::pi * 2.25;
  EXPECT_NEAR(coveredArea(draw()), exact, 0.02 * exact);
}

TEST_F(CanvasTest, AnArrowReachesFromItsTailToItsTip) {
  painter.arrow({10.0F, 40.0F}, {100.0F, 40.0F}, {.color = kWhite, .width = 4.0F});
  const Picture picture = draw();
  EXPECT_EQ(picture.at(10, 40), kWhite);
  EXPECT_EQ(picture.at(96, 40), kWhite);
  EXPECT_EQ(picture.at(8, 40), kBlack);
  EXPECT_EQ(picture.at(101, 40), kBlack);
  EXPECT_EQ(picture.at(86, 34), kWhite) << "the head is wider than the shaft";
  EXPECT_EQ(picture.at(60, 34), kBlack);
}

TEST_F(CanvasTest, ALayerIsClippedToItsBox) {
  drawing.layers.back().clip = PixelBox{30.0F, 20.0F, 40.0F, 30.0F};
  painter.box({0.0F, 0.0F, 120.0F, 80.0F}, 0.0F, {.fill = kWhite});
  painter.beginLayer();
  painter.box({0.0F, 0.0F, 5.0F, 5.0F}, 0.0F, {.fill = kRed});
  const Picture picture = draw();
  EXPECT_EQ(picture.at(29, 25), kBlack);
  EXPECT_EQ(picture.at(30, 20), kWhite);
  EXPECT_EQ(picture.at(69, 49), kWhite);
  EXPECT_EQ(picture.at(69, 50), kBlack);
  EXPECT_EQ(picture.at(2, 2), kRed);
}

TEST_F(CanvasTest, TextLeavesInkWhereItStands) {
  painter.write("C1", {16, Weight::Bold}, {20.0F, 40.0F}, kWhite);
  const Picture picture = draw();
  EXPECT_GT(coveredArea(picture), 60.0);
  for (int x = 0; x < 120; ++x) {
    EXPECT_EQ(picture.at(x, 45), kBlack);
    EXPECT_EQ(picture.at(x, 20), kBlack);
  }
}

TEST_F(CanvasTest, NewLettersAppearInLaterPictures) {
  painter.write("a", {16}, {20.0F, 40.0F}, kWhite);
  draw();
  drawing.layers.back().glyphs.clear();
  painter.write("Ω", {16}, {20.0F, 40.0F}, kWhite);
  EXPECT_GT(coveredArea(draw()), 20.0);
}

TEST_F(CanvasTest, SeveralCanvasesOnOneThreadDoNotDisturbEachOther) {
  painter.disc({60.0F, 40.0F}, 20.0F, {.fill = kRed});
  const Picture before = draw();
  Canvas other(64, 48);
  Drawing blue;
  blue.background = kBlue;
  EXPECT_EQ(other.draw(blue).at(1, 1), kBlue);
  EXPECT_EQ(draw().rgba, before.rgba);
}

TEST(Canvas, RefusesSizesOutOfRange) {
  EXPECT_THROW(Canvas(0, 10), IoError);
  EXPECT_THROW(Canvas(10, 100000), IoError);
}

TEST(Canvas, SaysWhatDrawsIt) {
  EXPECT_NE(Canvas(8, 8).description().find("Mesa"), std::string::npos);
}

}  // namespace
}  // namespace merge2d
