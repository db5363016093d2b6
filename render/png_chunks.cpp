#include "render/png_chunks.h"

#include <libdeflate.h>

#include <algorithm>

namespace merge2d {

PngChunks::PngChunks(std::span<const std::uint8_t> file) {
  const bool is_png = file.size() >= kPngSignature.size() &&
                      std::equal(kPngSignature.begin(), kPngSignature.end(), file.begin());
  if (is_png) rest_ = file.subspan(kPngSignature.size());
}

std::optional<PngChunk> PngChunks::next() {
  constexpr std::size_t kFrame = 12;  // length, type, checksum
  if (rest_.size() < kFrame) return {};
  const std::size_t length = fromBigEndian(rest_);
  if (length > rest_.size() - kFrame) return {};
  const PngChunk chunk{{reinterpret_cast<const char*>(rest_.data()) + 4, 4},
                       rest_.subspan(8, length)};
  rest_ = rest_.subspan(kFrame + length);
  return chunk;
}

std::array<std::uint8_t, 4> bigEndian(std::uint32_t n) {
  return {static_cast<std::uint8_t>(n >> 24), static_cast<std::uint8_t>(n >> 16 & 0xff),
          static_cast<std::uint8_t>(n >> 8 & 0xff), static_cast<std::uint8_t>(n & 0xff)};
}

std::uint32_t fromBigEndian(std::span<const std::uint8_t> b) {
  return std::uint32_t{b[0]} << 24 | std::uint32_t{b[1]} << 16 | std::uint32_t{b[2]} << 8 | b[3];
}

std::vector<std::uint8_t> pngChunk(std::string_view type, std::span<const std::uint8_t> data,
                                   std::span<const std::uint8_t> more) {
  std::vector<std::uint8_t> out;
  out.reserve(data.size() + more.size() + 12);
  const auto append = [&](const auto& bytes) { out.insert(out.end(), bytes.begin(), bytes.end()); };
  append(bigEndian(static_cast<std::uint32_t>(data.size() + more.size())));
  append(type);
  append(data);
  append(more);
  append(bigEndian(libdeflate_crc32(0, out.data() + 4, out.size() - 4)));
  return out;
}

}  // namespace merge2d
