#pragma once
/// Text as characters.

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace merge2d {

/// How many bytes the character at `at` has; 0 when it is not UTF-8 (RFC 3629: shortest form, no
/// surrogates, nothing above U+10FFFF).
inline std::size_t characterBytes(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[at + i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80u) return 1;
  const std::size_t bytes = lead < 0xC2u ? 0 : lead < 0xE0u ? 2 : lead < 0xF0u ? 3 : 4;
  if (bytes == 0 || lead > 0xF4u || bytes > text.size() - at) return 0;
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0u) != 0x80u) return 0;
  }
  const unsigned least = lead == 0xE0u ? 0xA0u : lead == 0xF0u ? 0x90u : 0x80u;
  const unsigned most = lead == 0xEDu ? 0x9Fu : lead == 0xF4u ? 0x8Fu : 0xBFu;
  return byte(1) >= least && byte(1) <= most ? bytes : 0;
}

/// The number of a whole UTF-8 character.
inline char32_t codePoint(std::string_view character) {
  const auto lead = static_cast<unsigned char>(character[0]);
  constexpr unsigned kLeadBits[] = {0x7Fu, 0x1Fu, 0x0Fu, 0x07u};
  char32_t code = lead & kLeadBits[std::min<std::size_t>(character.size(), 4) - 1];
  for (const char c : character.substr(1)) code = code << 6u | (static_cast<unsigned>(c) & 0x3Fu);
  return code;
}

/// Whether a terminal obeys the character rather than showing it (C0, DEL and C1), or shows the
/// text after it in another place than it stands in (marks of writing direction, breaks of lines).
inline bool isControl(std::string_view character) {
  const char32_t code = codePoint(character);
  if (code < 0x20u || (code >= 0x7Fu && code < 0xA0u)) return true;
  return code == 0x61Cu || (code >= 0x200Eu && code <= 0x200Fu) ||
         (code >= 0x2028u && code <= 0x202Eu) || (code >= 0x2066u && code <= 0x2069u);
}

/// Whether any of its characters is one.
inline bool hasControl(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view character =
        text.substr(i, std::max<std::size_t>(1, characterBytes(text, i)));
    if (isControl(character)) return true;
    i += character.size();
  }
  return false;
}

/// A control character as TOML would write it: \n, \u001b.
inline std::string escapedControl(std::string_view character) {
  constexpr std::string_view kControls = "\b\t\n\f\r", kLetters = "btnfr",
                             kHex = "0123456789abcdef";
  const std::size_t known = kControls.find(character);
  if (known != std::string_view::npos) return {'\\', kLetters[known]};
  const char32_t code = codePoint(character);
  std::string out = "\\u";
  for (const unsigned shift : {12u, 8u, 4u, 0u}) out += kHex[code >> shift & 0xFu];
  return out;
}

/// The text without what a terminal would obey: for messages, which quote what others wrote.
/// Control characters are escaped but for those in `kept`; bytes that are no UTF-8 become U+FFFD.
inline std::string escaped(std::string_view text, std::string_view kept = {}) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t bytes = characterBytes(text, i);
    const std::string_view character = text.substr(i, bytes > 0 ? bytes : 1);
    i += character.size();
    if (bytes == 0) {
      out += "\xEF\xBF\xBD";
    } else if (isControl(character) && kept.find(character) == std::string_view::npos) {
      out += escapedControl(character);
    } else {
      out += character;
    }
  }
  return out;
}

/// The text as one line: breaks of lines and tabs become a space, and it is `escaped`.
inline std::string asOneLine(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const bool gap = c == '\n' || c == '\r' || c == '\t';
    if (!gap) {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
  }
  while (line.ends_with(' ')) line.pop_back();
  return escaped(line);
}

/// As many whole characters from its beginning as fit into so many bytes.
inline std::string_view beginning(std::string_view text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  std::size_t end = 0;
  for (std::size_t next = 0; next <= bytes;) {
    end = next;
    const std::size_t size = characterBytes(text, next);
    next += size > 0 ? size : 1;
  }
  return text.substr(0, end);
}

}  // namespace merge2d
