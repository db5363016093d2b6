#include "src2d/scene/toml_scan.h"

namespace merge2d {
namespace {

class Scanner {
 public:
  Scanner(std::string_view text, const toml::source_position& end, std::size_t limit)
      : text_(text), end_(end), limit_(limit) {}

  TomlScan run() {
    if (sees("\xEF\xBB\xBF")) next_ += 3;  // a byte order mark takes no column
    while (!atEnd() && !result_.too_deep && !result_.unclosed_quote) readToken();
    return result_;
  }

 private:
  bool atEnd() const { return next_ >= text_.size() || !(place_ < end_); }
  bool sees(std::string_view word) const { return text_.substr(next_).starts_with(word); }

  void advance() {
    const auto byte = static_cast<unsigned char>(text_[next_++]);
    if (byte == '\n') {
      ++place_.line;
      place_.column = 1;
    } else if (next_ >= text_.size() ||
               (static_cast<unsigned char>(text_[next_]) & 0xC0u) != 0x80u) {
      ++place_.column;  // columns count characters, not bytes
    }
  }

  void readToken() {
    const char c = text_[next_];
    if (c == '"' || c == '\'') return readString(c);
    if (c == '#') return skipComment();
    if (!result_.stray && startsCharacterBeyondAscii()) result_.stray = {next_, place_};
    if (c == '[' || c == '{') result_.open.push_back({c, place_});
    if ((c == ']' || c == '}') && !result_.open.empty()) result_.open.pop_back();
    if (c == '.') ++dots_;
    if (c == '\n' || c == '=' || c == ',') dots_ = 0;
    if (result_.open.size() > limit_ || dots_ > limit_) result_.too_deep = place_;
    if (c == '=' && !result_.missing_value && !valueFollows()) result_.missing_value = place_;
    advance();
  }

  bool valueFollows() const {
    const std::size_t value = text_.find_first_not_of(" \t", next_ + 1);
    return value != std::string_view::npos &&
           std::string_view(",]}#\r\n").find(text_[value]) == std::string_view::npos;
  }

  /// A whole one; broken ones are left to the parser.
  bool startsCharacterBeyondAscii() const {
    const auto byte = [this](std::size_t i) {
      return next_ + i < text_.size() ? static_cast<unsigned char>(text_[next_ + i]) : 0u;
    };
    const std::size_t length = byte(0) >= 0xF0u ? 4 : byte(0) >= 0xE0u ? 3 : 2;
    if (byte(0) < 0xC0u || byte(0) >= 0xF8u) return false;
    for (std::size_t i = 1; i < length; ++i) {
      if ((byte(i) & 0xC0u) != 0x80u) return false;
    }
    return true;
  }

  void skipComment() {
    while (!atEnd() && text_[next_] != '\n') advance();
  }

  /// One of "…", '…', and both over several lines between three quotes.
  void readString(char quote) {
    const toml::source_position opened = place_;
    const std::string three(3, quote);
    const bool several_lines = sees(three);
    const std::string closing = several_lines ? three : three.substr(0, 1);
    for (std::size_t i = 0; i < closing.size(); ++i) advance();
    while (!atEnd() && !sees(closing) && (several_lines || text_[next_] != '\n')) {
      if (quote == '"' && text_[next_] == '\\') advance();
      if (!atEnd()) advance();
    }
    if (!sees(closing)) {
      result_.unclosed_quote = opened;
    } else {
      for (std::size_t i = 0; i < closing.size(); ++i) advance();
      // Up to two quotes before the closing three belong to the text.
      for (int i = 0; several_lines && i < 2 && !atEnd() && text_[next_] == quote; ++i) advance();
    }
  }

  std::string_view text_;
  toml::source_position end_;
  std::size_t limit_;
  std::size_t next_ = 0;
  std::size_t dots_ = 0;
  toml::source_position place_{1, 1};
  TomlScan result_;
};

}  // namespace

TomlScan scanToml(std::string_view text, const toml::source_position& end, std::size_t limit) {
  return Scanner(text, end, limit).run();
}

}  // namespace merge2d
