#include "lessons/markdown.h"

#include <cmark.h>

#include <cstdlib>
#include <memory>

namespace merge2d {

std::string markdownToHtml(std::string_view text) {
  const std::unique_ptr<char, decltype(&std::free)> html(
      cmark_markdown_to_html(text.data(), text.size(), CMARK_OPT_SMART | CMARK_OPT_VALIDATE_UTF8),
      std::free);
  return html.get();
}

std::vector<Section> sectionsOf(std::string_view text) {
  std::vector<Section> sections{{"", 1, ""}};
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.starts_with("## ")) {
      line.remove_prefix(3);
      sections.push_back({std::string(line), number, ""});
    } else {
      sections.back().text += std::string(line) + "\n";
    }
  }
  return sections;
}

}  // namespace merge2d
