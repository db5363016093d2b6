#pragma once
/// The chunks a PNG file consists of, for those who take files apart and put them together.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace merge2d {

inline constexpr std::array<std::uint8_t, 8> kPngSignature = {0x89, 'P',  'N',  'G',
                                                              '\r', '\n', 0x1a, '\n'};

struct PngChunk {
  std::string_view type;  ///< four letters
  std::span<const std::uint8_t> data;
};

/// Walks through a file's chunks; stops where a chunk is cut off.
class PngChunks {
 public:
  explicit PngChunks(std::span<const std::uint8_t> file);
  std::optional<PngChunk> next();

 private:
  std::span<const std::uint8_t> rest_;
};

/// The four bytes PNG stores a number in.
std::array<std::uint8_t, 4> bigEndian(std::uint32_t number);
std::uint32_t fromBigEndian(std::span<const std::uint8_t> bytes);

/// Length, type, data and checksum; the data may come in two parts.
std::vector<std::uint8_t> pngChunk(std::string_view type, std::span<const std::uint8_t> data,
                                   std::span<const std::uint8_t> more = {});

}  // namespace merge2d
