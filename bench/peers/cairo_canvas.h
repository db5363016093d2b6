#pragma once
/// Cairo drawing what our canvas draws: the boxes and arrows of a `Drawing`.

#include <cairo.h>

#include <cstddef>
#include <memory>

#include "render/drawing.h"

namespace merge2d::bench {

class CairoCanvas {
 public:
  CairoCanvas(int width, int height);

  void draw(const Drawing& drawing);
  /// Encodes the picture and tells the size of the file it would be.
  std::size_t encodePng();

 private:
  struct Free {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
  };

  std::unique_ptr<cairo_surface_t, Free> surface_;
  std::unique_ptr<cairo_t, Free> context_;
};

}  // namespace merge2d::bench
