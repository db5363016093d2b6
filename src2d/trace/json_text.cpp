#include "src2d/trace/json_text.h"

#include <fmt/compile.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

namespace merge2d {
namespace {

/// Whether the text can stand between quotes as it is.
bool plain(std::string_view text) {
  return std::ranges::all_of(text,
                             [](char c) { return c >= ' ' && c != '"' && c != '\\' && c < 0x7F; });
}

}  // namespace

void JsonText::putSeparator() {
  if (comma_) put(",");
}

JsonText& JsonText::open(char bracket) {
  putSeparator();
  buffer_.push_back(bracket);
  comma_ = false;
  return *this;
}

JsonText& JsonText::close(char bracket) {
  buffer_.push_back(bracket);
  comma_ = true;
  return *this;
}

JsonText& JsonText::key(std::string_view name) {
  value(name);
  put(":");
  comma_ = false;
  return *this;
}

JsonText& JsonText::raw(std::string_view json) {
  putSeparator();
  put(json);
  comma_ = true;
  return *this;
}

JsonText& JsonText::value(std::string_view text) {
  if (!plain(text)) {
    constexpr auto kReplace = nlohmann::json::error_handler_t::replace;
    return raw(nlohmann::json(text).dump(-1, ' ', false, kReplace));
  }
  putSeparator();
  put("\"");
  put(text);
  put("\"");
  comma_ = true;
  return *this;
}

JsonText& JsonText::value(double number) {
  if (!std::isfinite(number)) return raw("null");
  if (number == 0.0) return raw(std::signbit(number) ? "-0.0" : "0");
  putSeparator();
  fmt::format_to(std::back_inserter(buffer_), FMT_COMPILE("{}"), number);
  comma_ = true;
  return *this;
}

JsonText& JsonText::endLine() {
  put("\n");
  comma_ = false;
  return *this;
}

void JsonText::clear() {
  buffer_.clear();
  comma_ = false;
}

}  // namespace merge2d
