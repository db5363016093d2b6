#pragma once
/// Data goes to stdout, everything said about it to stderr.

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

#include "app/options.h"

namespace merge2d {

/// Opens /dev/null in place of a standard stream that is closed. Otherwise the next file that is
/// opened would get its number, and messages would be written into it. To be called first of all.
void openStandardStreams();

/// The reader of the standard output has closed its end of the pipe, as `head` does.
class ReaderGone : public std::runtime_error {
 public:
  ReaderGone() : std::runtime_error("nobody reads the standard output any more") {}
};

/// Writes to stdout. Throws what `failOutput` throws.
void print(std::string_view text);
/// Makes sure that everything printed has arrived. Throws what `failOutput` throws.
void flushOutput();
/// Throws the error of a write to stdout that failed with `errno`: ReaderGone, Interrupted
/// or IoError.
[[noreturn]] void failOutput();

/// Writes to stderr. A message that cannot be written is lost: it never fails a command.
void sayRaw(std::string_view text);
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
  /// "warning: …", on one line.
  void warn(std::string_view message) const;
  /// The same with lines below it that show the place, as an InputError has them.
  void warnOfPlace(std::string_view message) const;

 private:
  bool quiet_, verbose_;
};

}  // namespace merge2d
