#include "render/svg_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "render/contact_sheet.h"
#include "src2d/core/assert.h"
#include "src2d/core/utf8.h"

namespace merge2d {
namespace {

/// A document of toSvg without its declaration: the attributes of its <svg>, and its content.
struct SvgParts {
  std::string_view head, content;
};
SvgParts partsOf(std::string_view document) {
  constexpr std::string_view kOpen = "<svg ", kClose = "</svg>\n";
  MERGE2D_ASSERT(document.starts_with(kSvgStart), "{} bytes are no document of toSvg",
                 document.size());
  document.remove_prefix(kSvgStart.size() + kOpen.size());
  const std::size_t end = document.find('>');
  return {document.substr(0, end),
          document.substr(end + 2, document.size() - end - 2 - kClose.size())};
}

int numberOf(std::string_view head, std::string_view attribute) {
  const std::string start = fmt::format("{}=\"", attribute);
  const std::string_view value = head.substr(head.find(start) + start.size());
  int number = 0;
  std::from_chars(value.data(), value.data() + value.size(), number);
  return number;
}

/// The same with ids of its own. Text has no '<', so that all between '<' and '>' is markup.
std::string renamed(std::string_view content, std::string_view prefix) {
  constexpr std::string_view kId = "id=\"m-", kUse = "url(#m-";
  std::string out;
  bool markup = false;
  for (std::size_t i = 0; i < content.size(); ++i) {
    const std::string_view rest = content.substr(i);
    const bool names = markup && (rest.starts_with(kId) || rest.starts_with(kUse));
    if (names) {
      const std::string_view word = rest.starts_with(kId) ? kId : kUse;
      out += word.substr(0, word.size() - 2);
      out += prefix;
      out += '-';
      i += word.size() - 1;
      continue;
    }
    if (content[i] == '<') markup = true;
    if (content[i] == '>') markup = false;
    out += content[i];
  }
  return out;
}

}  // namespace

std::string svgSheet(std::span<const std::string> documents, int columns, int width,
                     Color background, SvgOptions options) {
  MERGE2D_ASSERT(!documents.empty() && columns > 0, "{} pictures in {} columns", documents.size(),
                 columns);
  const auto count = static_cast<int>(documents.size());
  const std::string_view first = partsOf(documents[0]).head;
  const int own_width = numberOf(first, "width"), own_height = numberOf(first, "height");
  width = std::min(width, own_width);
  const int height = (own_height * width + own_width / 2) / own_width;
  const int across = std::min(columns, count), down = (count + columns - 1) / columns;
  options.width = across * width + (across - 1) * kSheetGap;
  options.height = down * height + (down - 1) * kSheetGap;
  Drawing empty;
  empty.background = background;
  std::string sheet = toSvg(empty, options);
  sheet.erase(sheet.rfind("</svg>"));
  for (int i = 0; i < count; ++i) {
    const SvgParts parts = partsOf(documents[static_cast<std::size_t>(i)]);
    sheet += fmt::format(
        "<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" viewBox=\"0 0 {} {}\">\n{}</svg>\n",
        i % columns * (width + kSheetGap), i / columns * (height + kSheetGap), width, height,
        own_width, own_height, renamed(parts.content, fmt::format("m{}", i)));
  }
  return sheet + "</svg>\n";
}

}  // namespace merge2d
