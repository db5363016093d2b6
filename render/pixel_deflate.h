#pragma once
/// Deflate for pictures with large areas of one colour.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace merge2d {

/// Compresses the rows of a picture as PNG stores them: a filter byte 0 (none) and the pixels.
/// Sources: RFC 1950 (zlib), RFC 1951 (deflate). It looks for repetitions of whole pixels, and only
/// where a run of pixels ends: a general compressor visits each byte of a run. Keeps its buffers
/// for the next picture.
class PixelDeflate {
 public:
  /// `pixels` holds rows of `width` pixels, of which the `bytes` (1, 3 or 4) lowest bytes are
  /// stored, the lowest first; the other bytes must be the same in all pixels. The result is a zlib
  /// stream; it is valid until the next call.
  std::span<const std::uint8_t> compress(std::span<const std::uint32_t> pixels, std::size_t width,
                                         std::size_t bytes);

 private:
  static constexpr std::size_t kLiterals = 286, kDistances = 30;

  struct Match {
    std::uint32_t pixels = 0;    ///< how many are repeated
    std::uint32_t distance = 0;  ///< to where they were [bytes]
  };
  /// Pixels as they are, and the repeated ones after them.
  struct Token {
    std::uint32_t literal = 0;  ///< pixels
    Match match;
  };
  class Bits;

  void findTokens(std::span<const std::uint32_t> pixels);
  void findTokensOfRow(const std::uint32_t* first, std::size_t row);
  Match bestMatch(const std::uint32_t* first, std::size_t row, std::size_t x);
  void addToken(const std::uint32_t* pixel, const Token& token);
  void writeTrees(Bits& bits);
  void writeTokens(Bits& bits, std::span<const std::uint32_t> pixels) const;
  std::uint32_t checksum(std::span<const std::uint32_t> pixels);

  std::size_t width_ = 0, bytes_ = 0, most_ = 0;
  std::vector<Token> tokens_;        ///< row by row; each row ends with its last pixel
  std::vector<std::uint32_t> seen_;  ///< by hash of two pixels: where they were, from 1
  std::array<std::uint32_t, kLiterals> literal_counts_{};
  std::array<std::uint32_t, kDistances> distance_counts_{};
  std::vector<std::uint8_t> literal_lengths_, distance_lengths_;
  std::vector<std::uint16_t> literal_codes_, distance_codes_;
  std::vector<std::uint8_t> row_, out_;
};

}  // namespace merge2d
