#include "bench/peers/cairo_canvas.h"

#include <cmath>
#include <initializer_list>

namespace merge2d::bench {
namespace {

void setColor(cairo_t* cairo, Color c) {
  cairo_set_source_rgba(cairo, c.r / 255.0, c.g / 255.0, c.b / 255.0, c.a / 255.0);
}

Pixel turned(Pixel a) { return {-a.y, a.x}; }

void closedPath(cairo_t* cairo, std::initializer_list<Pixel> corners) {
  for (const Pixel& p : corners) cairo_line_to(cairo, p.x, p.y);
  cairo_close_path(cairo);
}

/// The middle of the box's outline: half a line inside of its boundary.
void boxPath(cairo_t* cairo, const ShapeInstance& box) {
  const float grow = box.radius - 0.5F * box.line;
  const Pixel x = box.axis * (box.half.x + grow);
  const Pixel y = turned(box.axis) * (box.half.y + grow);
  const Pixel& c = box.center;
  closedPath(cairo, {c + x + y, c - x + y, c - x - y, c + x - y});
}

void drawBox(cairo_t* cairo, const ShapeInstance& box) {
  boxPath(cairo, box);
  setColor(cairo, box.fill);
  cairo_fill_preserve(cairo);
  setColor(cairo, box.outline);
  cairo_set_line_width(cairo, box.line);
  cairo_stroke(cairo);
}

/// Shaft and head as one outline, its rim as a line around it.
void drawArrow(cairo_t* cairo, const ArrowInstance& arrow) {
  const Pixel whole = arrow.tip - arrow.tail;
  const Pixel along = whole * (1.0F / std::hypot(whole.x, whole.y));
  const Pixel neck = arrow.tip - along * arrow.head;
  const Pixel shaft = turned(along) * (0.5F * arrow.width);
  const Pixel barb = turned(along) * (0.5F * arrow.head);
  closedPath(cairo, {arrow.tail + shaft, neck + shaft, neck + barb, arrow.tip, neck - barb,
                     neck - shaft, arrow.tail - shaft});
  if (arrow.rim > 0.0F) {
    setColor(cairo, arrow.rim_color);
    cairo_set_line_width(cairo, 2.0 * arrow.rim);
    cairo_stroke_preserve(cairo);
  }
  setColor(cairo, arrow.color);
  cairo_fill(cairo);
}

cairo_status_t count(void* bytes, const unsigned char*, unsigned length) {
  *static_cast<std::size_t*>(bytes) += length;
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

CairoCanvas::CairoCanvas(int width, int height)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)),
      context_(cairo_create(surface_.get())) {
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
}

void CairoCanvas::draw(const Drawing& drawing) {
  cairo_t* cairo = context_.get();
  setColor(cairo, drawing.background);
  cairo_paint(cairo);
  for (const Layer& layer : drawing.layers) {
    for (const ShapeInstance& box : layer.shapes) drawBox(cairo, box);
    for (const ArrowInstance& arrow : layer.arrows) drawArrow(cairo, arrow);
  }
  cairo_surface_flush(surface_.get());
}

std::size_t CairoCanvas::encodePng() {
  std::size_t bytes = 0;
  cairo_surface_write_to_png_stream(surface_.get(), count, &bytes);
  return bytes;
}

}  // namespace merge2d::bench
