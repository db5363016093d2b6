#pragma once
/// Several pictures as one.

#include <span>

#include "render/picture.h"

namespace merge2d {

/// The picture made smaller by the least whole number that brings its width down to `width` [px];
/// each pixel is the mean of those it covers.
Picture shrunk(const Picture& picture, int width);

/// Between pictures of a sheet [px].
inline constexpr int kSheetGap = 8;

/// Pictures of one size in rows of `columns`, with a little space between them.
Picture contactSheet(std::span<const Picture> pictures, int columns, Color background);

}  // namespace merge2d
