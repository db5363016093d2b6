#pragma once
/// Captions with times, as players and browsers read them (WebVTT).

#include <cstdint>
#include <string>

namespace merge2d {

/// A file of captions of which each stands for one second.
class WebVtt {
 public:
  /// The caption from `second` to the next one; in order. Lines stay lines, markup becomes text.
  void add(std::int64_t second, const std::string& caption);

  /// How the file begins.
  static constexpr const char* kStart = "WEBVTT\n";
  const std::string& text() const { return text_; }

 private:
  std::string text_ = kStart;
};

}  // namespace merge2d
