#include "render/apng.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "render/png.h"
#include "render/png_chunks.h"
#include "src2d/core/error.h"
#include "tests/support/temporary_folder.h"

namespace merge2d {
namespace {

/// An animation of pictures of one colour each, at 25 per second.
std::filesystem::path animation(const TemporaryFolder& folder,
                                const std::vector<std::uint32_t>& colors) {
  const std::filesystem::path file = folder.path() / "a.png";
  ApngWriter writer(file, 25);
  for (const std::uint32_t color : colors) writer.add(Picture(16, 8, rgb(color)));
  writer.finish();
  return file;
}

TEST(Apng, HoldsAllFramesInOrder) {
  const TemporaryFolder folder;
  const auto bytes = readFileBytes(animation(folder, {0xff0000, 0x00ff00, 0x0000ff}));
  EXPECT_EQ(folder.count(), 1U);

  std::vector<std::string> types;
  std::uint32_t sequence = 0;
  PngChunks chunks(bytes);
  while (const auto chunk = chunks.next()) {
    types.emplace_back(chunk->type);
    if (chunk->type == "acTL") {
      EXPECT_EQ(fromBigEndian(chunk->data), 3U);
    }
    if (chunk->type == "fcTL" || chunk->type == "fdAT") {
      EXPECT_EQ(fromBigEndian(chunk->data), sequence++);
    }
    if (chunk->type == "fcTL") {
      EXPECT_EQ(fromBigEndian(chunk->data.subspan(4)), 16U);
      EXPECT_EQ(fromBigEndian(chunk->data.subspan(8)), 8U);
      EXPECT_EQ(fromBigEndian(chunk->data.subspan(20)), 1U << 16 | 25U) << "a 25th of a second";
    }
  }
  EXPECT_EQ(types, (std::vector<std::string>{"IHDR", "acTL", "fcTL", "IDAT", "fcTL", "fdAT", "fcTL",
                                             "fdAT", "IEND"}));
}

TEST(Apng, AFrameCanBeTakenOutAgain) {
  const TemporaryFolder folder;
  const auto bytes = readFileBytes(animation(folder, {0xff0000, 0x0000ff}));
  // The second frame's data without its sequence number is the data of a PNG file.
  std::vector<std::uint8_t> png(kPngSignature.begin(), kPngSignature.end());
  const auto append = [&](const std::vector<std::uint8_t>& b) {
    png.insert(png.end(), b.begin(), b.end());
  };
  PngChunks chunks(bytes);
  while (const auto chunk = chunks.next()) {
    if (chunk->type == "IHDR") append(pngChunk("IHDR", chunk->data));
    if (chunk->type == "fdAT") append(pngChunk("IDAT", chunk->data.subspan(4)));
  }
  append(pngChunk("IEND", {}));
  EXPECT_EQ(decodePng(png).at(3, 3), rgb(0x0000ff));
}

TEST(Apng, ReadersWithoutAnimationSeeTheFirstFrame) {
  const TemporaryFolder folder;
  EXPECT_EQ(loadPng(animation(folder, {0xff0000, 0x0000ff})).at(3, 3), rgb(0xff0000));
}

TEST(Apng, RefusesOddSizesAndFramesThatDiffer) {
  const TemporaryFolder folder;
  ApngWriter odd(folder.path() / "odd.png", 30);
  EXPECT_THROW(odd.add(Picture(15, 8)), IoError);
  ApngWriter writer(folder.path() / "a.png", 30);
  writer.add(Picture(16, 8));
  EXPECT_THROW(writer.add(Picture(18, 8)), IoError);
  EXPECT_THROW(writer.add(Picture(16, 8), true), IoError);
}

TEST(Apng, TakesFramesOfFewColoursTogetherWithOthers) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.png";
  const Picture flat(64, 64, rgb(0x336699));
  Picture colorful(64, 64);
  for (std::size_t i = 0; i < colorful.rgba.size(); ++i) {
    colorful.rgba[i] = i % 4 == 3 ? 255 : static_cast<std::uint8_t>(i * 37 + i / 91);
  }
  ApngWriter writer(file, 30);
  writer.add(encodePng(flat));  // has a palette
  writer.add(encodePng(colorful));
  writer.finish();
  EXPECT_EQ(loadPng(file).rgba, flat.rgba);
}

TEST(Apng, LeavesNothingBehindWhenItIsNotFinished) {
  const TemporaryFolder folder;
  {
    ApngWriter writer(folder.path() / "a.png", 30);
    writer.add(Picture(16, 8));
  }
  EXPECT_EQ(folder.count(), 0U);
}

TEST(EvenSize, RoundsUp) {
  EXPECT_EQ(evenSize(1280), 1280);
  EXPECT_EQ(evenSize(853), 854);
}

}  // namespace
}  // namespace merge2d
