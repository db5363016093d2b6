#pragma once
/// The boundary of a shape of a drawing as a path; the shape shader computes it pixel by pixel.

#include <string>
#include <vector>

#include "render/drawing.h"

namespace merge2d {

/// The corners of a shape's core in the picture, in order, clockwise as seen: one of a disc, two of
/// a line.
std::vector<Pixel> coreOf(const ShapeInstance& shape, const std::vector<Edge>& edges);

/// The path data of a core grown by `radius`, with round corners; `radius` below 0 shrinks it, by
/// its edges. Empty where nothing is left.
std::string outlinePath(const std::vector<Pixel>& core, float radius);

/// A coordinate with two digits behind the point, as short as may be.
std::string shortNumber(float value);

}  // namespace merge2d
