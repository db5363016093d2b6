#include "render/svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/painter.h"

namespace merge2d {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr Color kInkRed = rgb(0xff0000), kInkBlue = rgb(0x0000ff);

class Svg : public testing::Test {
 protected:
  Svg() { painter_.beginLayer(); }

  std::string text() const { return toSvg(drawing_, {.width = 100, .height = 80}); }
  static std::size_t count(const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
      ++found;
    }
    return found;
  }

  Drawing drawing_;
  Text letters_;
  Painter painter_{drawing_, letters_};
};

TEST_F(Svg, BeginsAsADocumentOfItsSize) {
  EXPECT_THAT(text(), AllOf(testing::StartsWith(std::string(kSvgStart)),
                            HasSubstr("viewBox=\"0 0 100 80\""), testing::EndsWith("</svg>\n")));
}

TEST_F(Svg, HasElementsOfPlainShapes) {
  painter_.disc({10, 20}, 5, {.fill = kInkRed});
  painter_.line({0, 0}, {10, 0}, 2, kInkBlue);
  painter_.box({5, 6, 20, 10}, 0, {.fill = kInkRed});
  EXPECT_THAT(text(),
              AllOf(HasSubstr("<circle cx=\"10\" cy=\"20\" r=\"5\" fill=\"#ff0000\"/>"),
                    HasSubstr("<line x1=\"0\" y1=\"0\" x2=\"10\" y2=\"0\" stroke=\"#0000ff\" "
                              "stroke-width=\"2\" stroke-linecap=\"round\"/>"),
                    HasSubstr("<rect x=\"5\" y=\"6\" width=\"20\" height=\"10\" "
                              "fill=\"#ff0000\"/>")));
}

TEST_F(Svg, AnOutlineLiesInsideOfTheBoundary) {
  const std::vector<Pixel> square = {{10, 10}, {30, 10}, {30, 30}, {10, 30}};
  painter_.polygon(square, 0, {.fill = kInkRed, .outline = kInkBlue, .line = 2});
  EXPECT_THAT(text(), AllOf(HasSubstr("<path d=\"M10 10L30 10L30 30L10 30Z\" fill=\"#0000ff\"/>"),
                            HasSubstr("L28 28L12 28"), HasSubstr("fill=\"#ff0000\"")));
}

TEST_F(Svg, APolygonInEitherOrientationGrowsOutwards) {
  for (const bool turned : {false, true}) {
    Drawing drawing;
    Painter painter(drawing, letters_);
    painter.beginLayer();
    std::vector<Pixel> triangle = {{20, 20}, {60, 20}, {40, 50}};
    if (turned) std::swap(triangle[0], triangle[1]);
    painter.polygon(triangle, 4, {.fill = kInkRed});
    const std::string svg = toSvg(drawing, {.width = 100, .height = 80});
    EXPECT_THAT(svg, AllOf(HasSubstr(" 16L"), HasSubstr("A4 4 0 0 1 "))) << "the upper side at 16";
  }
}

TEST_F(Svg, ATransparentFillDoesNotShowTheOutlineBelowIt) {
  painter_.disc({20, 20}, 10, {.fill = withAlpha(kInkRed, 0.5), .outline = kInkBlue, .line = 2});
  EXPECT_THAT(text(), AllOf(HasSubstr("fill-rule=\"evenodd\""), HasSubstr("fill-opacity=\"0.5\"")));
}

TEST_F(Svg, StripesAreAPatternThatEqualShapesShare) {
  const Hatch hatch{.color = kInkBlue, .stripes = {0.1F, 0.0F}, .phase = 0.0F, .width = 2.0F};
  for (const float x : {20.0F, 60.0F}) {
    painter_.disc({x, 20}, 10, {.fill = kInkRed, .hatch = hatch});
  }
  EXPECT_EQ(count(text(), "<pattern"), 1U);
  EXPECT_EQ(count(text(), "fill=\"url(#m-hatch1)\""), 2U);
  EXPECT_THAT(text(), HasSubstr("width=\"10\" height=\"10\" patternTransform=\"rotate(0) "
                                "translate(4 0)\""))
      << "a stripe of two pixels about x = 5";
}

TEST_F(Svg, TextStaysTextAndIsAsWideAsInPictures) {
  const Font font{.size = 16, .weight = Weight::Bold};
  const float end = painter_.write("a < b & \"c\"", font, {10, 30}, kInkRed);
  EXPECT_THAT(text(), AllOf(HasSubstr(">a &lt; b &amp; &quot;c&quot;</text>"),
                            HasSubstr("x=\"10\" y=\"30\" font-size=\"16\" font-weight=\"bold\"")));
  const std::string svg = text(), key = "textLength=\"";
  const std::size_t at = svg.find(key) + key.size();
  EXPECT_NEAR(std::stof(svg.substr(at)), end - 10, 0.01);
}

TEST_F(Svg, WhatIsNoTextOfXmlIsLeftOut) {
  painter_.write("a\x01z\xff", {}, {10, 30}, kInkRed);
  EXPECT_THAT(text(), Not(testing::ContainsRegex("[\x01\xff]")));
}

TEST_F(Svg, ALayerIsCutOffAtItsBox) {
  painter_.beginLayer(PixelBox{5, 5, 50, 40});
  painter_.disc({10, 20}, 5, {.fill = kInkRed});
  EXPECT_THAT(text(), AllOf(HasSubstr("<clipPath id=\"m-clip1\"><rect x=\"5\" y=\"5\" width=\"50\" "
                                      "height=\"40\"/>"),
                            HasSubstr("<g clip-path=\"url(#m-clip1)\">")));
}

TEST_F(Svg, AnArrowIsOnePathWithARimBelow) {
  painter_.arrow({0, 10}, {40, 10},
                 {.color = kInkRed, .rim = kInkBlue, .width = 4, .rim_width = 1});
  EXPECT_THAT(text(), AllOf(HasSubstr("stroke=\"#0000ff\" stroke-width=\"2\""),
                            HasSubstr("L40 10L"), HasSubstr("fill=\"#ff0000\"")));
}

TEST_F(Svg, IsTheSameEachTime) {
  painter_.write("text", {}, {10, 30}, kInkRed);
  EXPECT_EQ(text(), text());
}

}  // namespace
}  // namespace merge2d
