#pragma once
/// The text of a lesson: Markdown, in sections.

#include <string>
#include <string_view>
#include <vector>

namespace merge2d {

/// CommonMark to HTML, with tables and with formulas between dollars; HTML inside of the text is
/// left out.
std::string markdownToHtml(std::string_view text);

struct Section {
  std::string title;  ///< of its heading, "## Title"; empty for what stands before the first one
  std::size_t line = 1;
  std::string text;
};
/// Cuts at the headings of the second level.
std::vector<Section> sectionsOf(std::string_view text);

}  // namespace merge2d
