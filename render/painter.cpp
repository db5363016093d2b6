#include "render/painter.h"

#include <algorithm>
#include <cmath>

namespace merge2d {
namespace {

/// Twice the signed area: positive when x turns towards y.
float signedArea(std::span<const Pixel> v) {
  float sum = 0.0F;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Pixel a = v[i] - v[0], b = v[(i + 1) % v.size()] - v[0];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum;
}

}  // namespace

void Painter::beginLayer(std::optional<PixelBox> clip) {
  drawing_.layers.push_back({clip, {}, {}, {}, {}});
}

ShapeInstance& Painter::add(Pixel center, const Paint& paint) {
  ShapeInstance& s = layer().shapes.emplace_back();
  s.center = center;
  s.line = paint.line;
  s.fill = paint.fill;
  s.outline = paint.outline;
  s.hatch = paint.hatch.stripes;
  s.hatch_phase = paint.hatch.phase;
  s.hatch_width = paint.hatch.width;
  s.hatch_color = paint.hatch.color;
  return s;
}

void Painter::disc(Pixel center, float radius, const Paint& paint) {
  add(center, paint).radius = radius;
}

void Painter::box(Pixel center, Pixel axis, Pixel half, float radius, const Paint& paint) {
  ShapeInstance& s = add(center, paint);
  s.axis = axis;
  s.half = half;
  s.radius = radius;
}

void Painter::box(const PixelBox& area, float radius, const Paint& paint) {
  const Pixel half{0.5F * area.width, 0.5F * area.height};
  const float r = std::min({radius, half.x, half.y});
  box(Pixel{area.x, area.y} + half, {1.0F, 0.0F}, {half.x - r, half.y - r}, r, paint);
}

void Painter::polygon(std::span<const Pixel> vertices, float radius, const Paint& paint) {
  Pixel low = vertices[0], high = vertices[0];
  for (const Pixel v : vertices) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y)};
  }
  ShapeInstance& s = add((low + high) * 0.5F, paint);
  s.half = (high - low) * 0.5F;
  s.radius = radius;
  s.first_edge = static_cast<std::int32_t>(drawing_.edges.size());
  s.edge_count = static_cast<std::int32_t>(vertices.size());
  const std::size_t n = vertices.size();
  const bool forward = signedArea(vertices) > 0.0F;
  for (std::size_t i = 0; i < n; ++i) {
    const Pixel from = vertices[forward ? i : n - 1 - i];
    const Pixel to = vertices[forward ? (i + 1) % n : (2 * n - 2 - i) % n];
    drawing_.edges.push_back({from - s.center, to - from});
  }
}

void Painter::line(Pixel from, Pixel to, float width, Color color) {
  const Pixel along = to - from;
  const float length = std::hypot(along.x, along.y);
  const Pixel axis = length > 0.0F ? along * (1.0F / length) : Pixel{1.0F, 0.0F};
  box((from + to) * 0.5F, axis, {0.5F * length, 0.0F}, 0.5F * width, {.fill = color});
}

void Painter::arrow(Pixel tail, Pixel tip, const ArrowPaint& paint) {
  // A short arrow keeps its shape: the head gives way first.
  const float length = std::hypot(tip.x - tail.x, tip.y - tail.y);
  const float head = std::min(4.0F * paint.width, 0.7F * length);
  const float width = std::min(paint.width, 0.4F * head);
  layer().arrows.push_back({tail, tip, width, head, paint.rim_width, paint.color, paint.rim});
}

float Painter::write(std::string_view text, Font font, Pixel at, Color color, Align align) {
  const float width = text_.width(text, font);
  if (align == Align::Center) at.x -= 0.5F * width;
  if (align == Align::Right) at.x -= width;
  text_.set(layer().glyphs, text, font, at.x, at.y, color);
  layer().lines.push_back({std::string(text),
                           {std::round(at.x), std::round(at.y)},
                           width,
                           font.size,
                           font.weight == Weight::Bold,
                           color});
  return at.x + width;
}

}  // namespace merge2d
