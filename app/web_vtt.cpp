#include "app/web_vtt.h"

#include <fmt/format.h>

namespace merge2d {
namespace {

std::string clockText(std::int64_t second) {
  return fmt::format("{:02}:{:02}:{:02}.000", second / 3600, second / 60 % 60, second % 60);
}

/// What would be read as markup.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return out;
}

}  // namespace

void WebVtt::add(std::int64_t second, const std::string& caption) {
  text_ +=
      fmt::format("\n{} --> {}\n{}\n", clockText(second), clockText(second + 1), escaped(caption));
}

}  // namespace merge2d
