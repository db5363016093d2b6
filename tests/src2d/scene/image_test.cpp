/// Pictures of every kind that PNG knows mean their pixels.

#include "src2d/scene/image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "src2d/core/error.h"
#include "tests/src2d/scene/drawing_testing.h"

namespace merge2d {
namespace {

using testing::HasSubstr;

bool same(const Image& a, const Image& b) {
  const auto equal = [](const Image::Pixel& p, const Image::Pixel& q) {
    return p.r == q.r && p.g == q.g && p.b == q.b && p.a == q.a;
  };
  return a.width == b.width && a.height == b.height &&
         std::ranges::equal(a.pixels, b.pixels, equal);
}

/// A colour type of PNG with how many channels it has, and the depths that it allows.
struct ColorType {
  int color;
  int channels;
  std::vector<int> depths;
};
const std::vector<ColorType> kColorTypes{{0, 1, {1, 2, 4, 8, 16}},
                                         {2, 3, {8, 16}},
                                         {3, 1, {1, 2, 4, 8}},
                                         {4, 2, {8, 16}},
                                         {6, 4, {8, 16}}};

TEST(Image, AnInterlacedPictureIsThePlainOneWhateverItsKindAndSize) {
  std::mt19937_64 random(7);
  for (const auto& [color, channels, depths] : kColorTypes) {
    for (const int depth : depths) {
      for (const auto& [width, height] : {std::pair{1u, 1u}, {3u, 5u}, {8u, 8u}, {24u, 16u}}) {
        std::vector<std::string> samples;
        for (unsigned i = 0; i < width * height; ++i) {
          std::string sample;
          for (int bit = 0; bit < channels * depth; ++bit) sample += random() % 2 == 0 ? '0' : '1';
          samples.push_back(sample);
        }
        const auto sample = [&, w = width](std::uint32_t x, std::uint32_t y) {
          return samples[y * w + x];
        };
        PngKind kind{.depth = depth, .color = color};
        if (color == 3) kind.palette = std::string(3u << static_cast<unsigned>(depth), '\x55');
        for (std::size_t i = 0; i < kind.palette.size(); ++i) {
          kind.palette[i] = static_cast<char>(random());
        }
        const Image plain = decodePng(encodePng(width, height, kind, sample), "p.png");
        kind.interlaced = true;
        const Image interlaced = decodePng(encodePng(width, height, kind, sample), "i.png");
        EXPECT_TRUE(same(plain, interlaced))
            << "colour type " << color << ", " << depth << " bits, " << width << " x " << height;
      }
    }
  }
}

/// 16 bits v mean v / 65535, eight bits the nearest v' / 255.
TEST(Image, SixteenBitsAreRoundedToEight) {
  constexpr std::array<unsigned, 8> kValues{0, 127, 128, 129, 0x1234, 0x8000, 0xfffe, 0xffff};
  for (const bool interlaced : {false, true}) {
    const auto sample = [&](std::uint32_t x, std::uint32_t y) {
      return bits(kValues[x], 16) + bits(kValues[y], 16) + bits(0, 16);
    };
    const Image image = decodePng(
        encodePng(8, 8, {.depth = 16, .color = 2, .interlaced = interlaced}, sample), "deep.png");
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        const Image::Pixel& p = image.at(x, y);
        EXPECT_EQ(p.r, (kValues[static_cast<std::size_t>(x)] * 255 + 32767) / 65535);
        EXPECT_EQ(p.g, (kValues[static_cast<std::size_t>(y)] * 255 + 32767) / 65535);
        EXPECT_EQ(p.b, 0);
        EXPECT_EQ(p.a, 255);
      }
    }
  }
}

const PngKind kTwoColors{.depth = 4,
                         .color = 3,
                         .palette = std::string("\xff\xff\xff\x0a\x14\x1e", 6),
                         .alphas = "\x40"};

TEST(Image, APaletteGivesColoursAndTransparency) {
  const auto number = [](std::uint32_t x, std::uint32_t) { return bits(x, 4); };
  const Image image = decodePng(encodePng(2, 1, kTwoColors, number), "palette.png");
  EXPECT_EQ(image.at(0, 0).r, 255);
  EXPECT_EQ(image.at(0, 0).a, 0x40);
  EXPECT_EQ(image.at(1, 0).r, 10);
  EXPECT_EQ(image.at(1, 0).b, 30);
  EXPECT_EQ(image.at(1, 0).a, 255);
}

/// The message of the InputError of these bytes.
std::string refusal(const std::string& bytes) {
  try {
    decodePng(bytes, "bad.png");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Image, AColourBeyondThePaletteIsAnErrorThatNamesThePixel) {
  for (const bool interlaced : {false, true}) {
    PngKind kind = kTwoColors;
    kind.interlaced = interlaced;
    const auto number = [](std::uint32_t x, std::uint32_t y) {
      return bits(x == 3 && y == 2 ? 7 : 1, 4);
    };
    EXPECT_EQ(refusal(encodePng(5, 4, kind, number)),
              "bad.png: pixel (3, 2) has colour 7 of a palette that ends with 1");
  }
}

TEST(Image, AWidePictureIsReadUpToTheLimitOfADrawing) {
  const auto white = [](std::uint32_t, std::uint32_t) { return "1"; };
  const PngKind kind{.depth = 1, .color = 0};
  EXPECT_EQ(decodePng(encodePng(1'500'000, 2, kind, white), "wide.png").width, 1'500'000);
  EXPECT_EQ(refusal(encodePng(5'000'000, 1, kind, white)),
            "bad.png: a drawing has at most 4194304 pixels, this one has 5000000 x 1");
}

TEST(Image, WrongDataIsAnErrorAndNoCrash) {
  const auto white = [](std::uint32_t, std::uint32_t) { return bits(255, 8); };
  std::string bytes = encodePng(9, 9, {.depth = 8, .color = 0}, white);
  const std::size_t data = bytes.find("IDAT") + 4;
  bytes[data + 6] = static_cast<char>(bytes[data + 6] ^ 0x55);
  EXPECT_THAT(refusal(bytes), HasSubstr("bad.png: not a whole PNG picture ("));
}

}  // namespace
}  // namespace merge2d
