#include "lessons/player_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "src2d/core/suggest.h"

namespace merge2d {
namespace {

constexpr std::int64_t kMany = 1'000'000'000;

std::string lower(std::string_view text) {
  std::string out(text);
  std::ranges::transform(out, out.begin(), [](unsigned char c) { return std::tolower(c); });
  return out;
}

}  // namespace

std::vector<std::string> wordsOf(std::string_view line) {
  std::vector<std::string> words;
  std::string word;
  bool inside = false;
  char quote = 0;
  const auto finish = [&] {
    if (inside) words.push_back(word);
    word.clear();
    inside = false;
  };
  for (const char c : line) {
    if (quote != 0) {
      if (c == quote)
        quote = 0;
      else
        word += c;
    } else if (c == '"' || c == '\'') {
      quote = c;
      inside = true;
    } else if (c == '#' && !inside) {
      break;
    } else if (c == ' ' || c == '\t' || c == '\r') {
      finish();
    } else {
      word += c;
      inside = true;
    }
  }
  finish();
  return words;
}

std::int64_t readCount(const std::string& text, std::int64_t least) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < least || value > kMany) {
    throw Refusal(fmt::format("'{}' is not a whole number of {} or more", text, least));
  }
  return value;
}

std::int64_t countIn(const std::vector<std::string>& arguments) {
  return arguments.empty() ? 1 : readCount(arguments[0], 1);
}

Stage stageNamed(const std::string& text) {
  std::vector<std::string_view> names;
  std::vector<Stage> found;
  for (std::size_t i = 0; i < kStages; ++i) {
    const auto stage = static_cast<Stage>(i);
    names.emplace_back(name(stage));
    if (text == std::to_string(i + 1) || lower(name(stage)) == lower(text)) return stage;
    if (lower(name(stage)).starts_with(lower(text))) found.push_back(stage);
  }
  if (found.size() == 1) return found[0];
  throw Refusal(
      fmt::format("there is no stage '{}'{}; 'stages' lists them", text, didYouMean(text, names)));
}

const std::vector<std::string_view>& eventNames() {
  static const std::vector<std::string_view> kNames = {
      name(EventType::Merge), name(EventType::Unmerge), name(EventType::Sleep),
      name(EventType::Wake),  name(EventType::Impact),  name(EventType::Emit),
      name(EventType::Break)};
  return kNames;
}

Timeline::EventFilter eventFilter(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return [](const Event&) { return true; };
  const std::vector<std::string_view>& names = eventNames();
  const auto found = std::ranges::find(names, std::string_view(arguments[0]));
  if (found == names.end()) {
    throw Refusal(
        fmt::format("there is no event '{}'{}: merge, unmerge, sleep, wake, impact, emit or break",
                    arguments[0], didYouMean(arguments[0], names)));
  }
  return [kind = *found](const Event& e) { return kind == name(e.type); };
}

}  // namespace merge2d
