#pragma once
/// A number that changes with any byte of what it is made of (FNV-1a, 64 bits). It tells damage and
/// mix-ups, not forgery.

#include <cstdint>
#include <string_view>

namespace merge2d {

inline std::uint64_t digestOf(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

}  // namespace merge2d
