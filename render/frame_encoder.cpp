#include "render/frame_encoder.h"

#include "render/frame.h"
#include "render/svg.h"

namespace merge2d {

FrameEncoder::FrameEncoder(const std::vector<BodyInfo>& bodies, const BodyLooks& looks,
                           const FrameStyle& style)
    : bodies_(bodies), looks_(looks), style_(style) {
  if (style_.format == FrameFormat::Png) canvas_.emplace(style_.width, style_.height);
}

void FrameEncoder::draw(const Snapshot& snapshot, const CollectionSlots& slots) {
  description_ = describe(snapshot, style_);
  const Drawing drawing = composeFrame(text(), snapshot, bodies_, looks_, style_, slots);
  if (canvas_) {
    canvas_->draw(drawing, picture_);
  } else {
    svg_ = toSvg(drawing, {.width = style_.width,
                           .height = style_.height,
                           .title = style_.title,
                           .description = description_});
  }
}

std::span<const std::uint8_t> FrameEncoder::encode() {
  if (canvas_) {
    return encoder_.encode(picture_, {.alpha = style_.transparent, .description = description_});
  }
  return {reinterpret_cast<const std::uint8_t*>(svg_.data()), svg_.size()};
}

}  // namespace merge2d
