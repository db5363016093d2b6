#include "render/png.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "render/png_chunks.h"
#include "src2d/core/error.h"
#include "tests/support/temporary_folder.h"

namespace merge2d {
namespace {

/// Colours and opacities of all kinds.
Picture gradient(int width, int height, bool opaque) {
  Picture picture(width, height);
  for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
    picture.rgba[i] = static_cast<std::uint8_t>(i * 37 + i / 91);
    if (opaque && i % 4 == 3) picture.rgba[i] = 255;
  }
  return picture;
}

std::vector<std::string> chunkTypes(const std::vector<std::uint8_t>& png) {
  std::vector<std::string> types;
  PngChunks chunks(png);
  while (const auto chunk = chunks.next()) types.emplace_back(chunk->type);
  return types;
}

TEST(Png, AnOpaquePictureComesBackAsItWas) {
  const Picture picture = gradient(37, 21, true);
  EXPECT_EQ(decodePng(encodePng(picture)).rgba, picture.rgba);
}

TEST(Png, ATransparentPictureComesBackAsItWas) {
  const Picture picture = gradient(37, 21, false);
  EXPECT_EQ(decodePng(encodePng(picture, {.alpha = true})).rgba, picture.rgba);
}

TEST(Png, WithoutAlphaOnlyColoursAreKept) {
  const Picture picture = decodePng(encodePng(gradient(5, 4, false)));
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4) EXPECT_EQ(picture.rgba[i], 255);
}

/// Areas of one colour, slopes, and noise: rows and pixels that repeat near and far.
Picture patchwork(int width, int height, unsigned seed, unsigned colors) {
  Picture picture(width, height);
  std::uint32_t state = seed * 2654435761U + 1;
  const auto next = [&] { return (state = state * 1664525U + 1013904223U) >> 8; };
  std::uint32_t color = 0;
  unsigned run = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x<width; ++x, run -= run> 0 ? 1 : 0) {
      if (run == 0) {
        run = next() % 5 == 0 ? next() % 700 : next() % 4;
        color = next() % colors * 0x010305U;
      }
      std::uint8_t* p = picture.rgba.data() + picture.offset(x, y);
      for (int c = 0; c < 3; ++c) p[c] = static_cast<std::uint8_t>(color >> 8 * c);
      p[3] = static_cast<std::uint8_t>(255 - color % 3);
      if (y > 0 && next() % 50 > 0) std::copy_n(p - 4 * width, 4, p);
    }
  }
  return picture;
}

TEST(Png, AnyPictureComesBackAsItWas) {
  PngEncoder encoder;  // one for all: nothing of a picture may stay for the next one
  for (const int width : {1, 2, 86, 87, 300, 1301}) {
    for (const int height : {1, 9, 40}) {
      for (const unsigned colors : {1U, 2U, 200U, 60000U}) {
        const Picture picture = patchwork(width, height, 7, colors);
        const Picture back = decodePng(encoder.encode(picture, {.alpha = true}));
        ASSERT_EQ(back.rgba, picture.rgba) << width << "x" << height << ", " << colors;
      }
    }
  }
}

/// The kind of pixels: 2 colour, 3 palette, 6 colour and alpha.
int colorType(std::span<const std::uint8_t> png) { return PngChunks(png).next()->data[9]; }

TEST(Png, FewColoursAreAPaletteWhereThatIsSmaller) {
  const Picture few = patchwork(200, 100, 3, 40), many = gradient(200, 100, false);
  EXPECT_EQ(colorType(encodePng(few, {.alpha = true})), 3);
  EXPECT_LT(encodePng(few).size(), encodePng(few, {.palette = false}).size());
  EXPECT_EQ(colorType(encodePng(few, {.palette = false})), 2);
  EXPECT_EQ(colorType(encodePng(many, {.alpha = true})), 6);
  EXPECT_EQ(colorType(encodePng(gradient(16, 16, true))), 2)
      << "a palette of as many colours as pixels";
}

TEST(Png, HoldsNothingButThePicture) {
  EXPECT_EQ(chunkTypes(encodePng(gradient(8, 8, true))),
            (std::vector<std::string>{"IHDR", "IDAT", "IEND"}));
}

TEST(Png, CanCarryADescription) {
  const auto png = encodePng(gradient(8, 8, true), {.description = "Zwei Würfel, λ = 3 N s"});
  EXPECT_EQ(chunkTypes(png), (std::vector<std::string>{"IHDR", "iTXt", "IDAT", "IEND"}));
  const std::string bytes(png.begin(), png.end());
  EXPECT_NE(bytes.find("Zwei Würfel, λ = 3 N s"), std::string::npos);
  EXPECT_EQ(decodePng(png).width, 8);
}

TEST(Png, IsKnownAsOursByItsDescription) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "picture.png";
  savePng(file, gradient(8, 8, true), {.description = "a box", .dots_per_inch = 300.0});
  EXPECT_TRUE(isOurPng(file));
  savePng(file, patchwork(200, 100, 3, 255), {.description = "with a palette"});
  EXPECT_TRUE(isOurPng(file));
  savePng(file, gradient(8, 8, true));
  EXPECT_FALSE(isOurPng(file)) << "any program could have written it";
  const std::string text = "iTXtDescription";
  writeAtomically(file, std::vector<std::uint8_t>(text.begin(), text.end()));
  EXPECT_FALSE(isOurPng(file));
  EXPECT_FALSE(isOurPng(folder.path() / "missing.png"));
}

TEST(Png, CanSayHowLargeItIsInPrint) {
  const auto png = encodePng(gradient(8, 8, true), {.dots_per_inch = 300.0});
  EXPECT_EQ(chunkTypes(png), (std::vector<std::string>{"IHDR", "pHYs", "IDAT", "IEND"}));
  PngChunks chunks(png);
  chunks.next();
  const std::span<const std::uint8_t> size = chunks.next()->data;
  EXPECT_EQ(fromBigEndian(size), 11811U) << "per metre";
  EXPECT_EQ(fromBigEndian(size.subspan(4)), 11811U);
  EXPECT_EQ(size[8], 1) << "the unit is the metre";
}

TEST(Png, TheSamePictureGivesTheSameBytes) {
  EXPECT_EQ(encodePng(gradient(64, 64, true)), encodePng(gradient(64, 64, true)));
}

TEST(Png, DamagedFilesAreRefused) {
  std::vector<std::uint8_t> png = encodePng(gradient(32, 32, true));
  EXPECT_THROW(decodePng(std::span(png).first(4)), IoError);
  EXPECT_THROW(decodePng(std::span(png).first(png.size() / 2)), IoError);
  std::vector<std::uint8_t> flipped = png;
  flipped[png.size() / 2] ^= 0x55;
  EXPECT_THROW(decodePng(flipped), IoError);
  flipped = png;
  flipped[0] = 'x';
  EXPECT_THROW(decodePng(flipped), IoError);
}

TEST(Png, AHugeSizeIsRefusedBeforeAnyMemoryIsTaken) {
  std::vector<std::uint8_t> header = {0, 1, 0x86, 0xa0, 0, 1, 0x86, 0xa0, 8, 2, 0, 0, 0};
  std::vector<std::uint8_t> png(kPngSignature.begin(), kPngSignature.end());
  for (const auto& chunk : {pngChunk("IHDR", header), pngChunk("IDAT", {}), pngChunk("IEND", {})}) {
    png.insert(png.end(), chunk.begin(), chunk.end());
  }
  EXPECT_THROW(decodePng(png), IoError);
}

TEST(InspectPng, KnowsACompleteFileFromACutOne) {
  const auto png = encodePng(gradient(32, 20, true));
  const PngSummary whole = inspectPng(png);
  EXPECT_TRUE(whole.complete);
  EXPECT_EQ(whole.width, 32);
  EXPECT_EQ(whole.height, 20);
  EXPECT_FALSE(inspectPng(std::span(png).first(png.size() - 1)).complete);
  EXPECT_FALSE(inspectPng({}).complete);
}

TEST(WriteAtomically, LeavesOneFileWithAllBytes) {
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> bytes = {1, 2, 3};
  writeAtomically(folder.path() / "a.png", bytes);
  EXPECT_EQ(readFileBytes(folder.path() / "a.png"), bytes);
  EXPECT_EQ(folder.count(), 1U);
}

TEST(WriteAtomically, ReplacesWhatWasThere) {
  const TemporaryFolder folder;
  writeAtomically(folder.path() / "a", std::vector<std::uint8_t>{1, 2, 3});
  writeAtomically(folder.path() / "a", std::vector<std::uint8_t>{4});
  EXPECT_EQ(readFileBytes(folder.path() / "a"), (std::vector<std::uint8_t>{4}));
}

TEST(WriteAtomically, SaysWhichFileCannotBeWritten) {
  try {
    writeAtomically("/nowhere/at/all.png", std::vector<std::uint8_t>{1});
    FAIL() << "written";
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/at/all.png"), std::string::npos);
  }
}

}  // namespace
}  // namespace merge2d
