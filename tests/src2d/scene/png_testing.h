#pragma once
/// PNG files of all kinds, written byte by byte so that tests can also write wrong ones.

#include <zlib.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace merge2d {

/// The four bytes of a number, highest first.
inline std::string bigEndian(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes += static_cast<char>((number >> static_cast<unsigned>(shift)) & 0xffu);
  }
  return bytes;
}

/// Length, type, data and checksum.
inline std::string pngChunk(const std::string& type, const std::string& data) {
  const std::string checked = type + data;
  const auto crc =
      crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()));
  return bigEndian(static_cast<std::uint32_t>(data.size())) + checked +
         bigEndian(static_cast<std::uint32_t>(crc));
}

inline std::string zipped(const std::string& data) {
  uLongf size = compressBound(static_cast<uLong>(data.size()));
  std::string result(size, '\0');
  compress(reinterpret_cast<Bytef*>(result.data()), &size,
           reinterpret_cast<const Bytef*>(data.data()), static_cast<uLong>(data.size()));
  result.resize(size);
  return result;
}

struct PngKind {
  int depth = 8;  ///< bits per channel
  int color = 6;  ///< 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA
  bool interlaced = false;
  std::string palette = {};  ///< three bytes each
  std::string alphas = {};   ///< one byte for each of the first colours of the palette
};

/// `sample(x, y)` gives the bits of one pixel as "0101…".
inline std::string encodePng(
    std::uint32_t width, std::uint32_t height, const PngKind& kind,
    const std::function<std::string(std::uint32_t, std::uint32_t)>& sample) {
  struct Pass {
    std::uint32_t x, y, dx, dy;
  };
  const std::vector<Pass> adam7 = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                   {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
  const std::vector<Pass> plain = {{0, 0, 1, 1}};
  std::string data;
  for (const Pass& pass : kind.interlaced ? adam7 : plain) {
    for (std::uint32_t y = pass.y; y < height && pass.x < width; y += pass.dy) {
      std::string bits;
      for (std::uint32_t x = pass.x; x < width; x += pass.dx) bits += sample(x, y);
      while (bits.size() % 8 != 0) bits += '0';
      data += '\0';  // no filter
      for (std::size_t i = 0; i < bits.size(); i += 8) {
        data += static_cast<char>(std::stoi(bits.substr(i, 8), nullptr, 2));
      }
    }
  }
  const std::string header = bigEndian(width) + bigEndian(height) + static_cast<char>(kind.depth) +
                             static_cast<char>(kind.color) + std::string(2, '\0') +
                             static_cast<char>(kind.interlaced ? 1 : 0);
  return "\x89PNG\r\n\x1a\n" + pngChunk("IHDR", header) +
         (kind.palette.empty() ? "" : pngChunk("PLTE", kind.palette)) +
         (kind.alphas.empty() ? "" : pngChunk("tRNS", kind.alphas)) +
         pngChunk("IDAT", zipped(data)) + pngChunk("IEND", "");
}

}  // namespace merge2d
