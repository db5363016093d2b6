#pragma once
/// The meaning of a stage's marks, below the picture. Internal to the renderer.

#include <functional>
#include <string>
#include <vector>

#include "render/frame_parts.h"

namespace merge2d {

class StageLegend {
 public:
  /// Draws a sample that begins at `left`.
  using Sample = std::function<void(Painter&, Pixel left)>;

  /// `scene` must outlive the legend.
  explicit StageLegend(const FrameScene& scene) : scene_(scene) {}

  /// Words alone.
  void words(std::string meaning) { sample(std::move(meaning), 0.0F, nullptr); }
  /// `width` of the sample [design px].
  void sample(std::string meaning, float width, Sample draw) {
    entries_.push_back({std::move(meaning), width, std::move(draw)});
  }
  void arrow(const std::string& meaning, Color color, float width = 22.0F);
  void line(const std::string& meaning, Color color);
  void ring(const std::string& meaning, Color color);
  void dot(const std::string& meaning, Color color);
  void cross(const std::string& meaning, Color color);
  void mergedMark(const std::string& meaning);

  /// From left to right, as many as fit before the scale.
  void draw(Painter& painter) const;

 private:
  struct Entry {
    std::string meaning;
    float width;
    Sample draw;
  };

  const FrameScene& scene_;
  std::vector<Entry> entries_;
};

}  // namespace merge2d
