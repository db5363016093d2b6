#include "lessons/markdown.h"

#include <cmark.h>
#include <fmt/format.h>

#include <cstdlib>
#include <memory>

#include "lessons/mathml.h"

namespace merge2d {
namespace {

/// Private characters around the number of a piece of HTML that CommonMark is not to touch.
constexpr std::string_view kOpen = "\uE000", kClose = "\uE001";

std::string commonMark(std::string_view text) {
  const std::unique_ptr<char, decltype(&std::free)> html(
      cmark_markdown_to_html(text.data(), text.size(), CMARK_OPT_SMART | CMARK_OPT_VALIDATE_UTF8),
      std::free);
  return html.get();
}

/// Takes formulas and tables out of a text, and puts their HTML into that of the rest.
class Pieces {
 public:
  std::string keep(std::string html) {
    html_.push_back(std::move(html));
    return fmt::format("{}{}{}", kOpen, html_.size() - 1, kClose);
  }

  std::string putBack(std::string text) const {
    for (std::size_t i = html_.size(); i-- > 0;) {
      const std::string mark = fmt::format("{}{}{}", kOpen, i, kClose);
      const std::size_t at = text.find(mark);
      if (at == std::string::npos) continue;
      // A table is no part of a paragraph.
      const bool block = html_[i].starts_with("<table");
      const std::string paragraph = fmt::format("<p>{}</p>", mark);
      const std::size_t around = block ? text.find(paragraph) : std::string::npos;
      if (around != std::string::npos) {
        text.replace(around, paragraph.size(), html_[i]);
      } else {
        text.replace(at, mark.size(), html_[i]);
      }
    }
    return text;
  }

 private:
  std::vector<std::string> html_;
};

/// Where the formula that begins at a dollar ends, or npos: "$ 5" and "$5 and $6" are none.
std::size_t endOfFormula(std::string_view line, std::size_t begin) {
  if (begin + 1 >= line.size() || line[begin + 1] == ' ') return std::string_view::npos;
  for (std::size_t at = begin + 1; at < line.size(); ++at) {
    if (line[at] == '\\') {
      ++at;
    } else if (line[at] == '$') {
      const bool digit = at + 1 < line.size() && line[at + 1] >= '0' && line[at + 1] <= '9';
      return at == begin + 1 || line[at - 1] == ' ' || digit ? std::string_view::npos : at;
    }
  }
  return std::string_view::npos;
}

/// Formulas between dollars, outside of code.
std::string withoutFormulas(std::string_view line, Pieces& pieces) {
  std::string out;
  bool code = false;
  for (std::size_t at = 0; at < line.size(); ++at) {
    if (line[at] == '`') code = !code;
    if (!code && line[at] == '\\' && at + 1 < line.size()) {
      out += line.substr(at, 2);
      ++at;
      continue;
    }
    const std::size_t end =
        !code && line[at] == '$' ? endOfFormula(line, at) : std::string_view::npos;
    if (end == std::string_view::npos) {
      out += line[at];
      continue;
    }
    out += pieces.keep(mathMl(line.substr(at + 1, end - at - 1)));
    at = end;
  }
  return out;
}

std::vector<std::string_view> linesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

bool isRow(std::string_view line) { return line.size() > 1 && line.front() == '|'; }

/// "|---|:--|"
bool isRule(std::string_view line) {
  return isRow(line) && line.find('-') != std::string_view::npos &&
         line.find_first_not_of("|-: ") == std::string_view::npos;
}

/// The cells of a row, in Markdown themselves.
std::string rowOfTable(std::string_view line, std::string_view tag) {
  std::string out = "<tr>";
  line.remove_prefix(1);
  while (!line.empty()) {
    const std::size_t end = std::min(line.find('|'), line.size());
    if (end == line.size() && line.find_first_not_of(' ') == std::string_view::npos) break;
    std::string cell = commonMark(line.substr(0, end));
    line.remove_prefix(std::min(end + 1, line.size()));
    if (cell.starts_with("<p>")) cell = cell.substr(3, cell.rfind("</p>") - 3);
    out += fmt::format("<{0}>{1}</{0}>", tag, cell);
  }
  return out + "</tr>";
}

/// Text without tables: each becomes a paragraph that stands for it.
std::string withoutTables(const std::string& text, Pieces& pieces) {
  const std::vector<std::string_view> lines = linesOf(text);
  std::string out;
  bool fenced = false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].starts_with("```")) fenced = !fenced;
    if (fenced || !isRow(lines[i]) || i + 1 >= lines.size() || !isRule(lines[i + 1])) {
      out += lines[i];
      out += '\n';
      continue;
    }
    std::string table = fmt::format("<table><thead>{}</thead><tbody>", rowOfTable(lines[i], "th"));
    for (i += 2; i < lines.size() && isRow(lines[i]); ++i) table += rowOfTable(lines[i], "td");
    --i;
    out += fmt::format("\n{}\n\n", pieces.keep(table + "</tbody></table>"));
  }
  return out;
}

}  // namespace

std::string markdownToHtml(std::string_view text) {
  Pieces pieces;
  std::string plain;
  bool fenced = false;
  for (const std::string_view line : linesOf(text)) {
    if (line.starts_with("```")) fenced = !fenced;
    plain += fenced ? std::string(line) : withoutFormulas(line, pieces);
    plain += '\n';
  }
  return pieces.putBack(commonMark(withoutTables(plain, pieces)));
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
