/// The parser's own messages are exact but speak of value-terminators and bare keys; here they are
/// turned into what the writer of the file should do, at the place where to do it.

#include "src2d/scene/toml_parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>

#include "src2d/core/error.h"
#include "src2d/core/utf8.h"
#include "src2d/scene/scene.h"
#include "src2d/scene/toml_scan.h"

namespace merge2d {
namespace {

constexpr std::string_view kStray = "stray character";
constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

/// The byte at which character `column` (from 1) of a line starts.
std::size_t byteOf(std::string_view line, std::size_t column) {
  std::size_t byte = 0;
  while (byte < line.size() && column > 1) {
    ++byte;
    while (byte < line.size() && (static_cast<unsigned char>(line[byte]) & 0xC0u) == 0x80u) ++byte;
    --column;
  }
  return byte;
}

bool endsWord(char c) {
  return std::string_view(" \t=,[]{}\"'#").find(c) != std::string_view::npos;
}

/// One syntax error, looked at from several sides.
class SyntaxError {
 public:
  SyntaxError(const SourceText& source, const toml::source_position& place,
              std::string_view description)
      : source_(source),
        description_(description),
        place_(place),
        line_(source.line(place_.line)),
        scan_(scanToml(source.text(), place_, kUnlimited)) {
    findWord();
  }

  [[noreturn]] void report() {
    const std::string sentence = explain();
    throw InputError(source_.message(place_, sentence));
  }

 private:
  bool says(std::string_view part) const { return description_.find(part) != std::string::npos; }

  /// The unquoted word at the error.
  void findWord() {
    const std::size_t at = std::min(byteOf(line_, place_.column), line_.size());
    std::size_t begin = at;
    std::size_t end = at;
    while (begin > 0 && !endsWord(line_[begin - 1])) --begin;
    while (end < line_.size() && !endsWord(line_[end])) ++end;
    word_ = line_.substr(begin, end - begin);
    word_begin_ = begin;
  }

  void moveToWord() { moveTo(word_begin_); }
  void moveTo(std::size_t byte) {
    const auto starts = [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; };
    const auto before = line_.substr(0, byte);
    place_.column =
        static_cast<toml::source_index>(1 + std::count_if(before.begin(), before.end(), starts));
  }

  std::string explain() {
    if (says(kStray)) return stray();
    if (says("escape sequence")) return "write \\\\ for a backslash, or put the text in '…'";
    if (says("control character") && !says("string")) return "a control character is not allowed";
    if (scan_.unclosed_quote) return unclosedQuote();
    if (says("cannot redefine")) return redefined();
    if (says("parsing inline table")) return inlineTable();
    if (says("parsing array") && !says("saw comma")) return array();
    if (says("parsing table header")) return heading();
    if (says("expected '='") || (says("key-value pair") && says("end-of-file"))) return keyOnly();
    if (says("expected value, saw")) return "the value after '=' is missing";
    if (says("expected a comment or whitespace")) return afterValue();
    if (says("parsing root table")) return "a line is key = value, or a [heading]";
    const bool value =
        says("boolean") || says("value") || says("integer") || says("floating-point");
    return value && !word_.empty() ? wrongValue() : parsersWords();
  }

  std::string parsersWords() const {
    const std::size_t colon = description_.find(": ");
    const std::size_t begin = colon == std::string::npos ? 0 : colon + 2;
    return "this is not TOML: " + description_.substr(begin);
  }

  std::string stray() {
    if (word_.starts_with("“") || word_.starts_with("„")) return "use plain quotes: \"…\"";
    const auto first = static_cast<unsigned char>(word_.empty() ? ' ' : word_.front());
    if (std::isdigit(first) != 0 || first == '-' || first == '+') {
      moveToWord();
      return noNumber();
    }
    return "letters beyond a-z stand in \"quotes\" or after a #";
  }

  std::string unclosedQuote() {
    place_ = *scan_.unclosed_quote;
    return "the quote that ends this text is missing";
  }

  std::string redefined() {
    const std::size_t quote = description_.find('\'');
    const std::size_t end = description_.find('\'', quote + 1);
    const bool named = quote != std::string::npos && end != std::string::npos;
    const std::string name = named ? description_.substr(quote + 1, end - quote - 1) : "";
    if (says("as array-of-tables") || says("array")) {
      return fmt::format("'{0}' is a list of tables elsewhere: write [[{0}]] each time", name);
    }
    if (says("table header")) return fmt::format("there are two tables [{}]", name);
    moveTo(line_.find_first_not_of(" \t"));
    return named ? fmt::format("'{}' is given twice", name) : "this key has a value already";
  }

  std::string inlineTable() const {
    if (says("saw '\\n'") || says("end-of-file")) {
      return "a table in { } stands on one line: close it with }";
    }
    if (says("dangling comma")) return "no comma before }";
    return "a comma is missing here, or the } before it";
  }

  std::string array() const {
    const bool other_line = !scan_.open.empty() && scan_.open.back().place.line != place_.line;
    if (says("end-of-file") || other_line) {
      const auto line = scan_.open.empty() ? place_.line : scan_.open.back().place.line;
      return fmt::format("the list that begins in line {} misses a comma or its ] before here",
                         line);
    }
    return "a comma is missing here, or the ] before it";
  }

  std::string heading() const {
    const std::string_view start = line_.substr(std::min(line_.find('['), line_.size()));
    const bool twice = start.starts_with("[[");
    const std::string_view inside =
        start.substr(twice ? 2 : std::min<std::size_t>(1, start.size()));
    const std::string_view name = inside.substr(0, inside.find_first_of("] \t#"));
    if (name.empty()) return "a heading names a table: [solver] or [[body]]";
    return fmt::format("this heading should read {}{}{}", twice ? "[[" : "[", name,
                       twice ? "]]" : "]");
  }

  std::string keyOnly() const {
    if (says("saw ':'")) return "write '=' instead of ':'";
    const bool equals = line_.find('=') != std::string_view::npos && says("end-of-file");
    return equals ? "the value after '=' is missing" : "'=' and a value are missing here";
  }

  std::string afterValue() const {
    const char next = line_[std::min(byteOf(line_, place_.column), line_.size() - 1)];
    const std::string_view rest = line_.substr(byteOf(line_, place_.column));
    if (next == ',') return "one value only: decimals have a point, lists stand in [ ]";
    if (next == ']' || next == '}') return fmt::format("this {} closes nothing", next);
    if (rest.find('=') != std::string_view::npos) return "each key stands in a line of its own";
    const bool letter = std::isalpha(static_cast<unsigned char>(next)) != 0;
    return letter ? "only a # comment may follow the value (numbers have no units)"
                  : "only a # comment may follow the value";
  }

  std::string wrongValue() {
    moveToWord();
    std::string lower(word_);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return static_cast<char>(std::tolower(c)); });
    if (lower == "true" || lower == "false")
      return fmt::format("write {}, in small letters", lower);
    if (lower == "yes" || lower == "no" || lower == "on" || lower == "off") {
      return "write true or false";
    }
    const auto first = static_cast<unsigned char>(word_.front());
    if (first == '(') return "a list stands in square brackets: [1, 2]";
    if (std::isalpha(first) != 0 || first == '/' || first == '_') {
      if (lower == "pi" || lower.find('*') != std::string::npos) return noNumber();
      return fmt::format("a text needs quotes: \"{}\"", word_);
    }
    const bool beyond_double = says("floating-point: '") && says("could not be interpreted");
    if (says("not representable") || beyond_double) return fmt::format("{} is too large", word_);
    if (says("leading zeroes")) return "a number does not begin with 0";
    if (says("decimal digit, saw '.'") || word_.ends_with('.')) {
      return "a number has digits on both sides of its point: 0.5, 1.0";
    }
    return noNumber();
  }

  std::string noNumber() const {
    const std::size_t end = word_.find_first_not_of("+-.0123456789");
    const bool unit = end != std::string_view::npos && end > 0 &&
                      std::isdigit(static_cast<unsigned char>(word_[end - 1])) != 0 &&
                      word_.find_first_of("*/+()", end) == std::string_view::npos;
    return fmt::format("'{}' is not a number ({})", word_,
                       unit ? "numbers have no units" : "nothing is computed here");
  }

  const SourceText& source_;
  std::string description_;
  toml::source_position place_;
  std::string_view line_;
  TomlScan scan_;
  std::string_view word_;
  std::size_t word_begin_ = 0;
};

bool tripsParser(std::string_view text) {
  try {
    static_cast<void>(toml::parse(text));
  } catch (const toml::parse_error&) {
  } catch (const TomlAssertion&) {
    return true;
  }
  return false;
}

/// The first line of a text that trips the parser: the last one of the shortest piece that does.
toml::source_index trippingLine(std::string_view text) {
  std::vector<std::size_t> ends;
  for (std::size_t end = text.find('\n'); end < text.size(); end = text.find('\n', end + 1)) {
    ends.push_back(end + 1);
  }
  const auto first = std::partition_point(
      ends.begin(), ends.end(), [&](std::size_t end) { return !tripsParser(text.substr(0, end)); });
  return static_cast<toml::source_index>(first - ends.begin() + 1);
}

/// The place of the first byte that belongs to no character.
std::optional<toml::source_position> firstBrokenCharacter(std::string_view text) {
  toml::source_position place{1, 1};
  std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;  // a byte order mark takes no column
  while (at < text.size()) {
    const std::size_t bytes = characterBytes(text, at);
    if (bytes == 0) return place;
    if (text[at] == '\n') {
      ++place.line;
      place.column = 0;
    }
    ++place.column;
    at += bytes;
  }
  return std::nullopt;
}

/// The parser's assertions tell no place.
[[noreturn]] void reportAssertion(const SourceText& source, std::string_view text,
                                  const TomlScan& scan) {
  const toml::source_position place{trippingLine(text), 1};
  const bool no_value = scan.missing_value && scan.missing_value->line == place.line;
  if (no_value) {
    throw InputError(source.message(*scan.missing_value, "the value after '=' is missing"));
  }
  throw InputError(source.message(place, "a line is key = value, or a [heading]"));
}

/// A complaint about a text that is not saved as UTF-8 with LF or CR LF; empty for one that is.
std::string_view otherEncoding(std::string_view text) {
  const bool marked = (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) &&
                      text.find('\0') != std::string_view::npos;
  const bool zeros = text.size() >= 4 && text.size() % 2 == 0 &&
                     ((text[0] == 0 && text[2] == 0) != (text[1] == 0 && text[3] == 0));
  if (marked || zeros) return "this text is UTF-16: save it as UTF-8";
  const bool returns = text.find('\r') != std::string_view::npos;
  if (returns && text.find('\n') == std::string_view::npos && text.find('\r') + 1 < text.size()) {
    return "the lines of this text end with CR alone: save it with LF or CR LF";
  }
  return {};
}

}  // namespace

toml::table parseToml(const SourceText& source) {
  if (const std::string_view other = otherEncoding(source.text()); !other.empty()) {
    throw InputError(source.message({1, 1}, other));
  }
  if (const auto broken = firstBrokenCharacter(source.text())) {
    throw InputError(
        source.message(*broken, "this is not valid UTF-8 (is it text, and saved as UTF-8?)"));
  }
  constexpr toml::source_position kEnd{std::numeric_limits<toml::source_index>::max(), 1};
  const TomlScan scan = scanToml(source.text(), kEnd, SceneLimits::kNesting);
  if (scan.too_deep) {
    throw InputError(source.message(
        *scan.too_deep,
        fmt::format("lists and tables nest deeper than {} levels", SceneLimits::kNesting)));
  }
  // The parser does not always survive strange characters outside of texts, so it sees none.
  const auto text = source.text().substr(0, scan.stray ? scan.stray->byte : std::string_view::npos);
  try {
    toml::table table = toml::parse(text, std::string_view(source.name()));
    if (!scan.stray) return table;
  } catch (const toml::parse_error& error) {
    const toml::source_position place = error.source().begin;
    const bool earlier = !scan.stray || place.line < scan.stray->place.line;
    if (earlier) SyntaxError(source, place, error.description()).report();
  } catch (const TomlAssertion&) {
    reportAssertion(source, text, scan);
  }
  SyntaxError(source, scan.stray->place, kStray).report();
}

}  // namespace merge2d
