#pragma once
/// Data goes to stdout, everything said about it to stderr.

#include <fmt/format.h>

#include <string_view>

#include "app/options.h"

namespace merge2d {

/// Writes to stdout. Throws IoError when that fails.
void print(std::string_view text);
/// Makes sure that everything printed has arrived. Throws IoError.
void flushOutput();

/// "error: …" on stderr.
void printError(std::string_view message);

/// Whether stderr is a terminal that somebody watches: then there is a progress bar.
bool watchedTerminal();

/// The messages of a command.
class Console {
 public:
  explicit Console(const MessageOptions& options)
      : quiet_(options.quiet), verbose_(options.verbose) {}

  bool quiet() const { return quiet_; }

  /// Something worth knowing.
  void note(std::string_view message) const;
  /// Something for those who want to know more.
  void detail(std::string_view message) const;
  /// "warning: …".
  void warn(std::string_view message) const;

 private:
  bool quiet_, verbose_;
};

}  // namespace merge2d
