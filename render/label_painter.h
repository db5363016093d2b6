#pragma once
/// Texts on plates of which none covers another. Internal to the renderer.

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "render/frame_parts.h"

namespace merge2d {

/// How a text and its plate look.
struct Print {
  Font font;
  float pad_x = 5.0F, pad_y = 4.0F;  ///< between the text and the edge of its plate [design px]
  float line = 1.6F, corner = 4.0F;  ///< width of the edge, radius of its corners [design px]
};

/// A text on a plate; put down only where nothing has been written yet.
class LabelPainter {
 public:
  struct Label {
    std::string text;
    Print print;
    PixelBox plate;
    Color outline;
  };

  LabelPainter(Text& text, const FrameScene& scene) : text_(text), scene_(scene) {}

  /// Of the plate of a text [px²].
  float area(const std::string& text, const Print& print) const {
    const PixelBox plate = plateOf(text, print, {});
    return plate.width * plate.height;
  }

  /// False where the plate would leave the panel or cover another one.
  bool put(const std::string& text, const Print& print, Pixel at, Color outline) {
    const PixelBox plate = plateOf(text, print, at);
    if (!scene_.view.panel.contains(plate)) return false;
    for (const Label& other : labels_) {
      if (other.plate.overlaps(plate)) return false;
    }
    labels_.push_back({text, print, plate, outline});
    return true;
  }

  const std::vector<Label>& labels() const { return labels_; }

  void draw(Painter& painter) const {
    for (const Label& label : labels_) draw(painter, label);
  }

 private:
  void draw(Painter& painter, const Label& label) const {
    const auto& [text, print, plate, outline] = label;
    painter.box(
        plate, scene_.px(print.corner),
        {.fill = scene_.theme().background, .outline = outline, .line = scene_.px(print.line)});
    painter.write(text, print.font,
                  {plate.x + 0.5F * plate.width, plate.bottom() - scene_.px(print.pad_y)},
                  scene_.theme().ink, Align::Center);
  }

  PixelBox plateOf(const std::string& text, const Print& print, Pixel center) const {
    const float width = text_.width(text, print.font) + 2.0F * scene_.px(print.pad_x);
    const float height = text_.capHeight(print.font) + 2.0F * scene_.px(print.pad_y);
    return {std::round(center.x - 0.5F * width), std::round(center.y - 0.5F * height),
            std::round(width), std::round(height)};
  }

  Text& text_;
  const FrameScene& scene_;
  std::vector<Label> labels_;
};

/// Where the names of bodies and the labels of collections go in a frame.
struct FrameLabels {
  LabelPainter plates;
  std::vector<const CollectionView*> without;  ///< those that have no room for a label

  FrameLabels(Text& text, const FrameScene& scene);
};

}  // namespace merge2d
