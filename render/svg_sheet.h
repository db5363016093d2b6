#pragma once
/// Several vector pictures as one.

#include <span>
#include <string>

#include "render/color.h"
#include "render/svg.h"

namespace merge2d {

/// Documents of toSvg, of one size, in rows of `columns`, with a little space between them. Each is
/// at most `width` wide in the sheet [px]; `options` are those of the sheet, whose size follows.
/// They keep their titles and descriptions.
std::string svgSheet(std::span<const std::string> documents, int columns, int width,
                     Color background, SvgOptions options);

}  // namespace merge2d
