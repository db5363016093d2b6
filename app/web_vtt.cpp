#include "app/web_vtt.h"

#include <fmt/format.h>

#include "src2d/core/utf8.h"

namespace merge2d {
namespace {

std::string clockText(std::int64_t second) {
  return fmt::format("{:02}:{:02}:{:02}.000", second / 3600, second / 60 % 60, second % 60);
}

/// As text: without markup, and without an empty line, which would end the caption.
std::string shown(const std::string& text) {
  std::string out;
  for (const char c : escaped(text, "\n")) {
    const bool empty_line = c == '\n' && (out.empty() || out.back() == '\n');
    if (!empty_line) {
      out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    }
  }
  while (out.ends_with('\n')) out.pop_back();
  return out;
}

}  // namespace

void WebVtt::add(std::int64_t second, const std::string& caption) {
  text_ +=
      fmt::format("\n{} --> {}\n{}\n", clockText(second), clockText(second + 1), shown(caption));
}

}  // namespace merge2d
