#pragma once
/// Colours, sizes and shapes of the marks of stages. Internal to the renderer.

#include <string>
#include <utility>
#include <vector>

#include "render/frame_parts.h"

namespace merge2d {

class StagePens {
 public:
  /// `painter` and `scene` must outlive the pens.
  StagePens(Painter& painter, const FrameScene& scene) : painter_(painter), scene_(scene) {}

  // ---- colours and sizes ----

  const Theme& theme() const { return scene_.theme(); }
  Color good() const { return theme().internal_force; }
  Color bad() const { return theme().broken_contact; }
  Color soft() const { return theme().ink_soft; }
  Color pale(Color color) const { return mix(color, theme().background, 0.55); }
  /// From far below a threshold to above it.
  Color heat(double ratio) const;
  /// Of the mark of a contact [px].
  float radius() const;
  float lineWidth() const;

  // ---- shapes ----

  void arrow(Pixel from, Pixel to, Color color, float thicker = 1.0F);
  /// The vector `v` [m] in the world, `aside` pixels to its left; too long ones are cut.
  void vector(const Vec2& from, const Vec2& v, Color color, float thicker = 1.0F,
              float aside = 0.0F);
  void ring(Pixel at, float r, Color color, float width);
  void dot(Pixel at, float r, Color color);
  void cross(Pixel at, float r, Color color);
  /// Between two bodies in contact; a fixed one is met where the two meet.
  void link(const BodyPair& pair, const Vec2& meeting, float width, Color color);

  /// A text over all marks.
  void label(const std::string& text, Pixel at, Color outline) {
    labels_.push_back({text, at, outline});
  }
  /// Where two would overlap the first one stays.
  void drawLabels();

 private:
  struct Label {
    std::string text;
    Pixel at;
    Color outline;
  };

  Pixel end(BodyId id, const Vec2& meeting) const;

  Painter& painter_;
  const FrameScene& scene_;
  std::vector<Label> labels_;
};

}  // namespace merge2d
