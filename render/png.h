#pragma once
/// Pictures as PNG files.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "render/picture.h"
#include "render/pixel_deflate.h"

namespace merge2d {

struct PngOptions {
  bool alpha = false;          ///< keep the alpha channel
  bool palette = true;         ///< may have a palette: not where several pictures share a header
  std::string description{};   ///< text for those who cannot see the picture
  double dots_per_inch = 0.0;  ///< how large it is in print; 0: not said
};

/// Encodes pictures one after the other, in the same memory.
class PngEncoder {
 public:
  /// The bytes of a PNG file: fast rather than small, and nothing but the picture in them (no
  /// dates). A picture of few colours has a palette where that takes fewer bytes. The result is
  /// valid until the next call.
  std::span<const std::uint8_t> encode(const Picture& picture, const PngOptions& options = {});

 private:
  struct Image;

  void loadPixels(const Picture& picture, bool alpha);
  bool findPalette();
  void write(const Image& image, const Picture& picture, const PngOptions& options,
             std::vector<std::uint8_t>& out);

  PixelDeflate deflate_;
  std::vector<std::uint32_t> pixels_, indices_;
  std::vector<std::uint32_t> palette_;  ///< colours in the order in which they appear
  std::vector<std::uint8_t> out_, smaller_;
};

inline std::vector<std::uint8_t> encodePng(const Picture& picture, const PngOptions& options = {}) {
  PngEncoder encoder;
  const std::span<const std::uint8_t> bytes = encoder.encode(picture, options);
  return {bytes.begin(), bytes.end()};
}

/// Throws IoError for what is not a PNG, is damaged, or is larger than 8192 pixels a side.
Picture decodePng(std::span<const std::uint8_t> bytes);

/// The properties of a file that need no decoding.
struct PngSummary {
  bool complete = false;  ///< from the signature to the last chunk
  int width = 0, height = 0;
};
PngSummary inspectPng(std::span<const std::uint8_t> bytes);

/// Whether the file begins as those with a description do that were written here.
bool isOurPng(const std::filesystem::path& file);

/// Throws IoError.
std::vector<std::uint8_t> readFileBytes(const std::filesystem::path& file);
std::string readFileText(const std::filesystem::path& file);

/// The file appears with all its bytes or not at all (render/new_file.h); after a loss of power
/// too, where it is `durable`. Throws IoError.
void writeAtomically(const std::filesystem::path& file, std::span<const std::uint8_t> bytes,
                     bool durable = true);

inline Picture loadPng(const std::filesystem::path& file) { return decodePng(readFileBytes(file)); }
inline void savePng(const std::filesystem::path& file, const Picture& picture,
                    const PngOptions& options = {}) {
  writeAtomically(file, encodePng(picture, options));
}

}  // namespace merge2d
