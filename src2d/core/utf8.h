#pragma once
/// Text as characters.

#include <cstddef>
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

}  // namespace merge2d
