#include "src2d/scene/source_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "src2d/core/utf8.h"

namespace merge2d {
namespace {

/// Text that a terminal shows in one column, and never obeys.
std::string_view printable(std::string_view character, bool valid) {
  if (!valid) return "\xEF\xBF\xBD";  // U+FFFD
  return isControl(character) ? " " : character;
}

/// The part of a line around `column` (from 1, in characters) that fits a terminal, and the column
/// in that part.
std::pair<std::string, std::size_t> excerpt(std::string_view line, std::size_t column) {
  constexpr std::size_t kWidth = 96;
  constexpr std::size_t kBefore = 60;
  const std::size_t skip = column > kWidth ? column - kBefore : 0;
  std::string part;
  std::size_t character = 0;
  for (std::size_t i = 0; i < line.size() && ++character <= skip + kWidth;) {
    const std::size_t bytes = characterBytes(line, i), taken = std::max<std::size_t>(1, bytes);
    if (character > skip) part += printable(line.substr(i, taken), bytes > 0);
    i += taken;
  }
  return {part, column - std::min(column, skip)};
}

}  // namespace

SourceText::SourceText(std::string name, std::string_view text)
    : name_(std::move(name)), text_(text) {}

std::string_view SourceText::line(std::size_t number) const {
  std::string_view rest = text_;
  for (std::size_t i = 1; i < number; ++i) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) return {};
    rest.remove_prefix(end + 1);
  }
  std::string_view found = rest.substr(0, rest.find('\n'));
  if (found.ends_with('\r')) found.remove_suffix(1);
  return found;
}

PlacedMessage SourceText::message(const toml::source_position& where,
                                  std::string_view sentence) const {
  const auto [shown, column] = excerpt(line(where.line), where.column);
  std::string head = fmt::format("{}:{}:{}: {}", name_, where.line, where.column, sentence);
  if (shown.empty()) return {head, {}};
  const std::string caret(column > 0 ? column - 1 : 0, ' ');
  return {head, fmt::format("\n{:>5} | {}\n{:>5} | {}^", where.line, shown, "", caret)};
}

std::string SourceText::place(const toml::source_region& where) const {
  if (where.path && *where.path != name_) return *where.path;
  return fmt::format("line {}", where.begin.line);
}

void SourceText::fail(const toml::source_region& where, std::string_view sentence) const {
  if (where.path && *where.path != name_) {
    throw InputError(fmt::format("{}: {}", *where.path, sentence));
  }
  if (!where.begin) throw InputError(fmt::format("{}: {}", name_, sentence));
  throw InputError(message(where.begin, sentence));
}

}  // namespace merge2d
