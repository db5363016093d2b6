#pragma once
/// Animated PNG.

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "render/new_file.h"
#include "render/picture.h"

namespace merge2d {

/// Strings PNG pictures of one size together to an animation, without compressing them again.
/// Readers that know nothing of animation show the first picture.
class ApngWriter {
 public:
  /// The file appears when `finish` is called. Throws IoError.
  ApngWriter(const std::filesystem::path& file, int frames_per_second);

  /// A frame as the bytes of a PNG file. Throws IoError for another size or kind of pixels than
  /// the first frame's, and for odd sizes. A frame with a palette is encoded anew, with or without
  /// alpha.
  void add(std::span<const std::uint8_t> png, bool alpha = false);
  void add(const Picture& picture, bool alpha = false);
  void finish();

  std::uint32_t frames() const { return frames_; }

 private:
  void writeHeader(std::span<const std::uint8_t> ihdr);
  std::vector<std::uint8_t> animationControl() const;
  void writeFrameControl();

  NewFile file_;
  std::uint16_t frames_per_second_;
  std::vector<std::uint8_t> header_;  ///< IHDR of the first frame
  std::uint64_t control_ = 0;         ///< where acTL stands
  std::uint32_t frames_ = 0, sequence_ = 0;
};

}  // namespace merge2d
