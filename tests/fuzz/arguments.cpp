/// Command lines, a word in each line: the program itself, but for commands that write files or
/// take long.

#include <algorithm>
#include <array>
#include <vector>

#include "app/program.h"
#include "tests/fuzz/harness.h"

namespace merge2d::fuzz {
namespace {

bool startsWithAny(std::string_view word, std::initializer_list<std::string_view> starts) {
  return std::any_of(starts.begin(), starts.end(),
                     [&](std::string_view start) { return word.starts_with(start); });
}

/// Whether a word may be tried: it neither writes, nor asks for a long run.
bool isTame(std::string_view word) {
  if (word.find('\0') != std::string_view::npos || word.size() > 200) return false;
  if (startsWithAny(word, {"-o", "--output", "--trace", "--csv", "--snapshot", "--to", "--render",
                           "--seconds", "--steps", "--weld", "--at", "--memory-limit"})) {
    return false;
  }
  constexpr std::array<std::string_view, 5> kCommands{"render", "lesson", "compare", "step",
                                                      "doctor"};
  return std::find(kCommands.begin(), kCommands.end(), word) == kCommands.end();
}

/// Adds options that keep a simulating command short.
void shorten(std::vector<std::string>& words) {
  const auto has = [&](std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  if (has("explain")) words.insert(words.end(), {"--at", "3"});
  if (has("run")) words.insert(words.end(), {"--steps", "3"});
}

}  // namespace

void tryInput(std::string_view bytes) {
  static const bool silent = std::freopen("/dev/null", "w", stdout) != nullptr &&
                             std::freopen("/dev/null", "r", stdin) != nullptr;
  require(silent, "the standard streams can be sent away");
  std::vector<std::string> words;
  while (!bytes.empty() && words.size() < 12) {
    const std::string_view line = bytes.substr(0, bytes.find('\n'));
    bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
    if (isTame(line)) words.emplace_back(line);
  }
  shorten(words);
  const int code = runProgram(words);
  require(code >= kFine && code <= kOutputFailed, "the exit codes are those that are stated");
}

}  // namespace merge2d::fuzz
