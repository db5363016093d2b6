/// What drawings say when they are wrong, or seldom meant: the pixel, and what to do.

#include "src2d/scene/drawing_doubts.h"

#include <fmt/format.h>

#include "src2d/scene/ink.h"
#include "tests/src2d/scene/drawing_testing.h"

namespace merge2d {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

TEST(DrawingDoubts, AVerticalHorizonIsAnError) {
  EXPECT_EQ(drawingError(encode({"c #", "   ", "c  "})),
            "bad.png: pixel (0, 0) is cyan, and the other cyan one (0, 2) is straight below it, so "
            "that no side of their line is the ground: move one of them sideways");
}

TEST(DrawingDoubts, ABodyThatIsBlueInPartIsWarnedAbout) {
  EXPECT_THAT(draw({"###  b", "#b#  b"}).warnings,
              ElementsAre(EndsWith(
                  "drawn.png: pixel (1, 1) is blue, but its body has other colours too, such as "
                  "#000000 at (0, 0), and is not pinned: a body is pinned where all of it is blue; "
                  "draw the rest in blue, or leave a white gap to what touches it")));
  EXPECT_THAT(draw({"#b   b  b#"}).warnings,
              ElementsAre(AllOf(HasSubstr("pixel (1, 0) is blue"), EndsWith("(2 bodies are so)"))));
  EXPECT_THAT(draw({"byb  r#"}).warnings, IsEmpty()) << "yellow is no matter";
}

TEST(DrawingDoubts, WhereNothingIsHeldAWarningSaysThatAllFalls) {
  const std::string falls =
      "drawn.png: nothing is pinned for good or held by a spring, so everything, such as the body "
      "at pixel (1, 1), falls for ever: draw a floor all in blue, or two lone cyan pixels";
  EXPECT_THAT(draw({"    ", " # e"}).warnings, ElementsAre(EndsWith(falls))) << "green is let go";
  EXPECT_THAT(draw({"    ", " #b "}).warnings,
              ElementsAre(HasSubstr("(2, 1) is blue"), EndsWith(falls)));
  for (const Rows& rows : {Rows{"# b"}, Rows{"# r"}, Rows{" # ", "   ", "c c"}}) {
    EXPECT_THAT(draw(rows).warnings, IsEmpty()) << rows.back();
  }
  EXPECT_THAT(draw({"#"}, {{"gravity", "[0, 0]"}}).warnings, IsEmpty());
  EXPECT_THAT(draw({"#"}, {{"body.body1.motion", "pinned"}}).warnings, IsEmpty());
}

TEST(DrawingDoubts, WhatIsOutOfRangeIsNamedByItsPixel) {
  const auto error = [](const Rows& rows, const std::string& key, const std::string& value) {
    try {
      draw(rows, {{key, value}});
    } catch (const InputError& wrong) {
      return std::string(wrong.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(error({" #"}, "material.density", "1e-12"),
              HasSubstr("drawn.png: pixel (1, 0) starts a body of 1e-14 kg: change "
                        "material.density or drawing.pixel"));
  EXPECT_THAT(error({" #"}, "drawing.pixel", "6e5"),
              HasSubstr("drawn.png: with drawing.pixel = 600000 this picture is 1.2e+06 m large"));
  EXPECT_THAT(error({" r###################"}, "gravity", "[0, 1e12]"),
              HasSubstr("drawn.png: pixel (1, 0) is a spring of "));
  EXPECT_EQ(error({" #"}, "drawing.pixel", "5e5"), "no error");
}

TEST(DrawingDoubts, DoubtfulColoursAreWarnedAboutWithTheirFirstPixelAndTheirNumber) {
  const Scene scene = draw({"#  ww",  //
                            "  b q"});
  ASSERT_EQ(scene.warnings.size(), 2u);
  EXPECT_THAT(
      scene.warnings[0],
      HasSubstr("drawn.png: pixel (3, 0) of colour #f6f6f6 is taken as empty, but is nearly "
                "plain matter (2 such pixels)"));
  EXPECT_THAT(
      scene.warnings[1],
      HasSubstr("drawn.png: pixel (4, 1) of colour #ed1c24 is taken as plain matter, but is "
                "nearly a spring (red)"));
}

/// A red line between white and white, and one of its pixels is half way to white.
TEST(DrawingDoubts, MixturesOfNeighboursAreWarnedAbout) {
  EXPECT_TRUE(isBlend({255, 128, 128, 255}, {255, 255, 255, 255}, {255, 0, 0, 255}));
  EXPECT_FALSE(isBlend({128, 128, 128, 255}, {255, 255, 255, 255}, {0, 0, 0, 255}));  // matter
  EXPECT_FALSE(isBlend({255, 255, 0, 255}, {255, 255, 255, 255}, {255, 0, 0, 255}));
  const std::string warning = doubtsAboutColours({3,
                                                  3,
                                                  {{255, 255, 255, 255},
                                                   {255, 255, 255, 255},
                                                   {255, 255, 255, 255},
                                                   {255, 255, 255, 255},
                                                   {255, 128, 128, 255},
                                                   {255, 0, 0, 255},
                                                   {255, 255, 255, 255},
                                                   {255, 255, 255, 255},
                                                   {255, 255, 255, 255}}})
                                  .at(0);
  EXPECT_EQ(warning,
            "pixel (1, 1) of colour #ff8080 is taken as plain matter, but is a mixture of what is "
            "beside it: draw without smoothed borders (anti-aliasing)");
}

TEST(DrawingDoubts, WrongOverridesAreNamed) {
  EXPECT_THROW(draw({"#"}, {{"drawing.pixle", "1"}}), InputError);
  EXPECT_THROW(draw({"#"}, {{"body.body2.mass", "1"}}), InputError);
}

TEST(DrawingDoubts, ATooLargePictureIsRefusedBeforeItIsRead) {
  const std::string header =
      bigEndian(50'000) + bigEndian(50'000) + std::string("\x08\x06\0\0\0", 5);
  const std::string file = "\x89PNG\r\n\x1a\n" + pngChunk("IHDR", header) +
                           pngChunk("IDAT", zipped("")) + pngChunk("IEND", "");
  EXPECT_EQ(drawingError(file),
            "bad.png: a drawing has at most 4194304 pixels, this one has 50000 x 50000");
}

TEST(DrawingDoubts, TooManyBodiesAreRefused) {
  Rows rows(700, std::string(700, ' '));
  for (std::size_t y = 0; y < 700; y += 2) {
    for (std::size_t x = 0; x < 700; x += 2) rows[y][x] = '#';
  }
  EXPECT_EQ(
      drawingError(encode(rows)),
      "bad.png: pixel (500, 570) is one body too many: a scene has at most 100000, this "
      "drawing has 122500; is it a photograph, or full of specks? All that touches is one body");
}

TEST(DrawingDoubts, ABodyOfTooManyPiecesIsRefused) {
  Rows rows(300, std::string(300, ' '));
  for (std::size_t y = 0; y < 300; ++y) {
    for (std::size_t x = y % 2; x < 300; x += 2) rows[y][x] = '#';
  }
  EXPECT_EQ(drawingError(encode(rows)),
            "bad.png: pixel (0, 0) starts a body of 45000 rectangles, at most 10000 are allowed: "
            "fill its holes, or straighten its edges");
}

TEST(DrawingDoubts, WhatIsNotAPngIsOneError) {
  EXPECT_EQ(drawingError(""), "bad.png: the file is empty");
  const std::pair<std::string, std::string> others[] = {{"GIF89a…", "GIF"},
                                                        {"\xFF\xD8\xFF\xE0 JFIF", "JPEG"},
                                                        {std::string("BM....\0\0\0\0", 10), "BMP"},
                                                        {"RIFF....WEBP", "WebP"}};
  for (const auto& [bytes, kind] : others) {
    EXPECT_EQ(
        drawingError(bytes),
        fmt::format("bad.png: this is a {} picture, whatever its name: save it as PNG", kind));
  }
  EXPECT_EQ(drawingError("BMX is no picture"), "bad.png: not a PNG picture");
  EXPECT_EQ(drawingError("Dear diary, nothing happened.\n"), "bad.png: not a PNG picture");
  for (const std::size_t length : {4, 8, 20, 40}) {
    EXPECT_EQ(drawingError(encode({"#"}).substr(0, length)),
              "bad.png: not a whole PNG picture (its end is missing)");
  }
}

TEST(DrawingDoubts, ATruncatedOrDamagedFileNeverCrashes) {
  const std::string whole = encode({"##  r", "#e# b", "  yym"});
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const std::string message = drawingError(whole.substr(0, length));
    EXPECT_THAT(message, StartsWith("bad.png: ")) << length;
  }
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const unsigned flip : {0x01u, 0x80u, 0xffu}) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(static_cast<unsigned char>(damaged[i]) ^ flip);
      const std::string message = drawingError(damaged);
      EXPECT_TRUE(message.starts_with("bad.png: ") || message == "no error") << message;
    }
  }
}

}  // namespace
}  // namespace merge2d
