#pragma once
/// Pictures as PNG files.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "render/picture.h"

namespace merge2d {

struct PngOptions {
  bool alpha = false;          ///< keep the alpha channel
  std::string description{};   ///< text for those who cannot see the picture
  double dots_per_inch = 0.0;  ///< how large it is in print; 0: not said
};

/// The bytes of a PNG file: fast rather than small, and nothing but the picture in them (no dates).
std::vector<std::uint8_t> encodePng(const Picture& picture, const PngOptions& options = {});

/// Throws IoError for what is not a PNG, is damaged, or is larger than 8192 pixels a side.
Picture decodePng(std::span<const std::uint8_t> bytes);

/// What can be told of a file without decoding it.
struct PngSummary {
  bool complete = false;  ///< from the signature to the last chunk
  int width = 0, height = 0;
};
PngSummary inspectPng(std::span<const std::uint8_t> bytes);

/// Whether the file begins as those with a description do that were written here.
bool isOurPng(const std::filesystem::path& file);

/// Throws IoError.
std::vector<std::uint8_t> readFileBytes(const std::filesystem::path& file);

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
