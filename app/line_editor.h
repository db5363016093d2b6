#pragma once
/// Lines that a person types, with editing, history and completion (libedit).

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace merge2d {

/// There may be only one at a time.
class LineEditor {
 public:
  /// The completions of the last word of a line.
  using Completions = std::function<std::vector<std::string>(const std::string& line)>;

  explicit LineEditor(Completions completions);
  ~LineEditor();
  LineEditor(const LineEditor&) = delete;
  LineEditor& operator=(const LineEditor&) = delete;

  /// The next line, or nothing at its end (Ctrl-D).
  std::optional<std::string> read(const std::string& prompt);
};

}  // namespace merge2d
