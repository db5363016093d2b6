#pragma once
/// The meaning of the words of a line to the player.

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "lessons/timeline.h"
#include "src2d/core/utf8.h"

namespace merge2d {

/// A line that cannot be done; the message says what would be right.
class Refusal : public std::runtime_error {
 public:
  explicit Refusal(const std::string& message) : std::runtime_error(escaped(message)) {}
};

/// The words of a line; "…" and '…' hold blanks together, '#' starts a comment.
std::vector<std::string> wordsOf(std::string_view line);

/// A whole number of `least` or more. Throws Refusal.
std::int64_t readCount(const std::string& text, std::int64_t least);
/// The first argument, or 1. Throws Refusal.
std::int64_t countIn(const std::vector<std::string>& arguments);

/// A stage by its number, its name, or the beginning of it. Throws Refusal.
Stage stageNamed(const std::string& text);

/// The kinds of events, as one writes them.
const std::vector<std::string_view>& eventNames();
/// Events of the kind that the first argument names, or all. Throws Refusal.
Timeline::EventFilter eventFilter(const std::vector<std::string>& arguments);

}  // namespace merge2d
