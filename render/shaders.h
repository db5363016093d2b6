#pragma once
/// The sources of the three programs: shapes, arrows, text. Coordinates are pixels, y down; colours
/// are premultiplied where they are blended; coverage comes from signed distances to edges.

namespace merge2d::shaders {

struct Source {
  const char* vertex;
  const char* fragment;
};

extern const Source kShape;
extern const Source kArrow;
extern const Source kGlyph;

}  // namespace merge2d::shaders
