#pragma once
/// The second back end of a `Drawing`: vector graphics for papers and pages. It needs no OpenGL.

#include <string>
#include <string_view>

#include "render/drawing.h"

namespace merge2d {

/// How every file begins that toSvg makes.
inline constexpr std::string_view kSvgStart =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- merge2d -->\n";

struct SvgOptions {
  int width = 0, height = 0;    ///< of the picture [px]
  std::string title{};          ///< for those who cannot see it, and for search
  std::string description{};    ///< the same, at length
  std::string id_prefix = "m";  ///< of the ids inside; differs between pictures of one page
  bool inner = false;           ///< part of a page: without the XML declaration
};

/// The drawing as one SVG 1.1 document. Text stays text, in DejaVu Sans or a similar face, as wide
/// as it is in pictures.
std::string toSvg(const Drawing& drawing, const SvgOptions& options);

}  // namespace merge2d
