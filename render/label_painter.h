#pragma once
/// Texts on plates of which none covers another. Internal to the renderer.

#include <cmath>
#include <string>
#include <vector>

#include "render/frame_parts.h"

namespace merge2d {

/// A text on a plate; put down only where nothing has been written yet.
class LabelPainter {
 public:
  LabelPainter(Painter& painter, const FrameScene& scene) : painter_(painter), scene_(scene) {}

  /// Of the plate of a text [px²].
  float area(const std::string& text, Font font) const {
    const PixelBox plate = plateOf(text, font, {});
    return plate.width * plate.height;
  }

  bool put(const std::string& text, Font font, Pixel at, Color outline) {
    const PixelBox plate = plateOf(text, font, at);
    if (!scene_.view.panel.contains(plate)) return false;
    for (const PixelBox& other : taken_) {
      if (other.overlaps(plate)) return false;
    }
    taken_.push_back(plate);
    painter_.box(plate, scene_.px(4.0F),
                 {.fill = scene_.theme().background, .outline = outline, .line = scene_.px(1.6F)});
    painter_.write(text, font, {plate.x + 0.5F * plate.width, plate.bottom() - scene_.px(kPadY)},
                   scene_.theme().ink, Align::Center);
    return true;
  }

 private:
  static constexpr float kPadX = 5.0F, kPadY = 4.0F;  // [design px]

  PixelBox plateOf(const std::string& text, Font font, Pixel center) const {
    const float width = painter_.text().width(text, font) + 2.0F * scene_.px(kPadX);
    const float height = painter_.text().capHeight(font) + 2.0F * scene_.px(kPadY);
    return {std::round(center.x - 0.5F * width), std::round(center.y - 0.5F * height),
            std::round(width), std::round(height)};
  }

  Painter& painter_;
  const FrameScene& scene_;
  std::vector<PixelBox> taken_;
};

}  // namespace merge2d
