#pragma once
/// From a snapshot to the bytes of a frame's file: pixels as PNG, or shapes as SVG.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/canvas.h"
#include "render/palette.h"
#include "render/png.h"
#include "render/silhouette.h"
#include "render/style.h"

namespace merge2d {

/// Draws one frame after another; their memory is used again. Belongs to one thread.
class FrameEncoder {
 public:
  /// `bodies` and `looks` must outlive the encoder. Throws IoError where there is no OpenGL, which
  /// SVG does not need.
  FrameEncoder(const std::vector<BodyInfo>& bodies, const BodyLooks& looks,
               const FrameStyle& style);

  /// Composes the frame, and draws it where it is made of pixels.
  void draw(const Snapshot& snapshot, const CollectionSlots& slots);
  /// The file of the frame that was drawn last, until the next one.
  std::span<const std::uint8_t> encode();

 private:
  Text& text() { return canvas_ ? canvas_->text() : text_; }

  const std::vector<BodyInfo>& bodies_;
  const BodyLooks& looks_;
  const FrameStyle style_;
  std::string description_;
  std::optional<Canvas> canvas_;  ///< none for SVG
  Picture picture_;
  PngEncoder encoder_;
  Text text_;
  std::string svg_;
};

}  // namespace merge2d
