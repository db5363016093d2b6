/// Source: W3C, Portable Network Graphics (Third Edition), 2025, section 11.3.6 (acTL, fcTL, fdAT).

#include "render/apng.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/png.h"
#include "render/png_chunks.h"
#include "src2d/core/error.h"

namespace merge2d {
namespace {

using Bytes = std::vector<std::uint8_t>;

void append(Bytes& out, std::uint32_t number) {
  const auto bytes = bigEndian(number);
  out.insert(out.end(), bytes.begin(), bytes.end());
}

}  // namespace

ApngWriter::ApngWriter(const std::filesystem::path& file, int frames_per_second)
    : file_(file),
      frames_per_second_(static_cast<std::uint16_t>(std::clamp(frames_per_second, 1, 1000))) {}

void ApngWriter::add(const Picture& picture, bool alpha) {
  add(encodePng(picture, {.alpha = alpha, .palette = false}));
}

void ApngWriter::add(std::span<const std::uint8_t> png, bool alpha) {
  PngChunks chunks(png);
  const auto header = chunks.next();
  if (!header || header->type != "IHDR") throw IoError("not a PNG file");
  constexpr std::size_t kColorType = 9;  // its place in IHDR
  constexpr std::uint8_t kPalette = 3;   // of which an animation has only one for all frames
  if (header->data.size() > kColorType && header->data[kColorType] == kPalette) {
    return add(decodePng(png), alpha);
  }
  if (frames_ == 0) writeHeader(header->data);
  if (!std::ranges::equal(header->data, header_)) {
    throw IoError("the frames of an animation must have the same size and kind of pixels");
  }
  writeFrameControl();
  while (const auto chunk = chunks.next()) {
    if (chunk->type != "IDAT") continue;
    if (frames_ == 0) {
      file_.write(pngChunk("IDAT", chunk->data));
    } else {
      file_.write(pngChunk("fdAT", bigEndian(sequence_++), chunk->data));
    }
  }
  ++frames_;
}

void ApngWriter::writeHeader(std::span<const std::uint8_t> ihdr) {
  const std::uint32_t width = fromBigEndian(ihdr), height = fromBigEndian(ihdr.subspan(4));
  if (width % 2 != 0 || height % 2 != 0) {
    throw IoError(fmt::format("an animation needs even sizes, not {}x{}", width, height));
  }
  header_.assign(ihdr.begin(), ihdr.end());
  file_.write(kPngSignature);
  file_.write(pngChunk("IHDR", ihdr));
  control_ = file_.size();
  file_.write(animationControl());
}

/// The number of frames, which is known at the end only: written twice.
std::vector<std::uint8_t> ApngWriter::animationControl() const {
  Bytes data;
  append(data, frames_);
  append(data, 0);  // plays: for ever
  return pngChunk("acTL", data);
}

void ApngWriter::writeFrameControl() {
  constexpr std::uint8_t kKeep = 0, kReplace = 0;
  Bytes data;
  append(data, sequence_++);
  data.insert(data.end(), header_.begin(), header_.begin() + 8);  // width and height
  append(data, 0);                                                // x offset
  append(data, 0);                                                // y offset
  const std::uint16_t fps = frames_per_second_;
  for (const int byte : {0, 1, fps >> 8, fps & 0xff})
    data.push_back(static_cast<std::uint8_t>(byte));
  data.push_back(kKeep);
  data.push_back(kReplace);
  file_.write(pngChunk("fcTL", data));
}

void ApngWriter::finish() {
  if (frames_ == 0) throw IoError("an animation needs at least one frame");
  file_.write(pngChunk("IEND", {}));
  file_.writeAt(control_, animationControl());
  file_.finish();
}

}  // namespace merge2d
