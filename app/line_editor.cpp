#include "app/line_editor.h"

#include <editline/readline.h>

#include <cstdlib>
#include <cstring>
#include <memory>
#include <utility>

namespace merge2d {
namespace {

// libedit's callbacks have no place for data of ours.
LineEditor::Completions g_completions;  // NOLINT
std::vector<std::string> g_found;       // NOLINT

char* nextCompletion(const char*, int state) {
  const auto i = static_cast<std::size_t>(state);
  return i < g_found.size() ? strdup(g_found[i].c_str()) : nullptr;
}

char** complete(const char* text, int, int end) {
  g_found = g_completions(std::string(rl_line_buffer, static_cast<std::size_t>(end)));
  rl_attempted_completion_over = 1;  // no names of files
  return g_found.empty() ? nullptr : rl_completion_matches(text, nextCompletion);
}

}  // namespace

LineEditor::LineEditor(Completions completions) {
  static char program[] = "merge2d", blanks[] = " \t";
  g_completions = std::move(completions);
  rl_readline_name = program;
  rl_attempted_completion_function = complete;
  rl_completer_word_break_characters = blanks;
  using_history();
}

LineEditor::~LineEditor() {
  rl_attempted_completion_function = nullptr;
  g_completions = nullptr;
  clear_history();
}

std::optional<std::string> LineEditor::read(const std::string& prompt) {
  const std::unique_ptr<char, decltype(&std::free)> line(readline(prompt.c_str()), &std::free);
  if (!line) return std::nullopt;
  if (*line) add_history(line.get());
  return std::string(line.get());
}

}  // namespace merge2d
