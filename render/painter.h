#pragma once
/// Puts shapes, arrows and text into a `Drawing`, in pixels.

#include <span>
#include <string_view>

#include "render/drawing.h"
#include "render/text.h"

namespace merge2d {

/// Stripes across a fill, fixed to the picture.
struct Hatch {
  Color color;
  Pixel stripes;       ///< stripes per pixel along x and y
  float phase = 0.0F;  ///< in stripes
  float width = 1.0F;  ///< of a stripe [px]
};

struct Paint {
  Color fill{};
  Color outline{};
  float line = 0.0F;  ///< width of the outline, inside of the boundary [px]
  Hatch hatch{};
};

struct ArrowPaint {
  Color color{};
  Color rim{};
  float width = 2.0F;      ///< of the shaft [px]
  float rim_width = 0.0F;  ///< [px]
};

enum class Align { Left, Center, Right };

class Painter {
 public:
  Painter(Drawing& drawing, Text& text) : drawing_(drawing), text_(text) {}

  Text& text() { return text_; }

  /// The drawing that follows lies over the earlier one, inside of `clip`.
  void beginLayer(std::optional<PixelBox> clip = {});

  void disc(Pixel center, float radius, const Paint& paint);
  /// A box of `half` extents along `axis`, grown by `radius`, which rounds its corners.
  void box(Pixel center, Pixel axis, Pixel half, float radius, const Paint& paint);
  /// An upright box that fills `area`, with corners of `radius`.
  void box(const PixelBox& area, float radius, const Paint& paint);
  /// A convex polygon in either orientation, grown by `radius`.
  void polygon(std::span<const Pixel> vertices, float radius, const Paint& paint);
  /// A line with round ends.
  void line(Pixel from, Pixel to, float width, Color color);
  void arrow(Pixel tail, Pixel tip, const ArrowPaint& paint);
  /// A line of text at its baseline; returns where it ends.
  float write(std::string_view text, Font font, Pixel at, Color color, Align align = Align::Left);

 private:
  Layer& layer() { return drawing_.layers.back(); }
  ShapeInstance& add(Pixel center, const Paint& paint);

  Drawing& drawing_;
  Text& text_;
};

}  // namespace merge2d
