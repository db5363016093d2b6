#pragma once
/// Shapes to be drawn by a canvas (render/canvas.h) or as SVG (render/svg.h): plain lists,
/// arrows and text in pixels, x to the right and y down from the top left corner of the picture.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/color.h"

namespace merge2d {

/// A point or direction in the picture [px].
struct Pixel {
  float x = 0.0F, y = 0.0F;

  Pixel operator+(Pixel o) const { return {x + o.x, y + o.y}; }
  Pixel operator-(Pixel o) const { return {x - o.x, y - o.y}; }
  Pixel operator*(float s) const { return {s * x, s * y}; }
};

/// One instance of the shape shader: a convex core grown by `radius`. Everything outlined is one:
///   disc      half (0, 0), radius r
///   line      half (length/2, 0), radius width/2
///   box       half its half extents, radius that of its corners
///   polygon   `edge_count` entries of Drawing::edges, and half the extents of its bounding box
struct ShapeInstance {
  Pixel center;
  Pixel axis{1.0F, 0.0F};  ///< unit, the shape's own x axis
  Pixel half;              ///< of the core, along its own axes
  float radius = 0.0F;
  float line = 0.0F;  ///< width of the outline, inside of the boundary
  Pixel hatch;        ///< stripes per pixel along x and y; 0 for none
  float hatch_phase = 0.0F;
  float hatch_width = 0.0F;  ///< width of a stripe [px]
  std::int32_t first_edge = 0, edge_count = 0;
  Color fill, outline, hatch_color;
};

/// A vertex of a polygon about the shape's centre, and the edge that starts there.
struct Edge {
  Pixel from, along;
};

/// A shaft with a head, in one quad, with a rim of another colour around it.
struct ArrowInstance {
  Pixel tail, tip;
  float width = 2.0F;  ///< of the shaft
  float head = 8.0F;   ///< length of the head, and its width
  float rim = 0.0F;
  Color color, rim_color;
};

/// A rectangle of the glyph atlas at whole pixels.
struct GlyphInstance {
  std::int16_t x = 0, y = 0, width = 0, height = 0;  ///< in the picture
  std::int16_t u = 0, v = 0;                         ///< in the atlas
  Color color;
};

/// A line of text as text, for pictures that are not made of pixels.
struct TextLine {
  std::string text;  ///< UTF-8
  Pixel start;       ///< of its baseline, at whole pixels
  float width = 0.0F;
  int size = 13;  ///< per em [px]
  bool bold = false;
  Color color;
};

struct PixelBox {
  float x = 0.0F, y = 0.0F, width = 0.0F, height = 0.0F;

  float right() const { return x + width; }
  float bottom() const { return y + height; }
  bool overlaps(const PixelBox& o) const {
    return x < o.right() && o.x < right() && y < o.bottom() && o.y < bottom();
  }
  bool contains(const PixelBox& o) const {
    return x <= o.x && y <= o.y && o.right() <= right() && o.bottom() <= bottom();
  }
};

/// Shapes, then arrows, then text; each in the order of its list.
struct Layer {
  std::optional<PixelBox> clip;
  std::vector<ShapeInstance> shapes;
  std::vector<ArrowInstance> arrows;
  std::vector<GlyphInstance> glyphs;
  std::vector<TextLine> lines;  ///< the same text
};

/// Layers from back to front.
struct Drawing {
  Color background;
  std::vector<Layer> layers;
  std::vector<Edge> edges;
};

}  // namespace merge2d
