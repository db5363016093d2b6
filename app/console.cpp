#include "app/console.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <system_error>

#include "app/interrupt.h"
#include "src2d/core/error.h"
#include "src2d/core/utf8.h"

namespace merge2d {
namespace {

bool isSet(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

bool terminal() {
  const char* kind = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && (kind == nullptr || std::string_view(kind) != "dumb");
}

/// Lines with what they quote; `heading` is ours, and may have colours.
void say(std::string_view lines, std::string_view heading = {}) {
  sayRaw(fmt::format("{}{}\n", heading, escaped(lines, "\n")));
}

/// "error:" or "warning:", in colour where that can be seen (no-color.org).
std::string heading(std::string_view word, int color) {
  if (!terminal() || isSet("NO_COLOR")) return fmt::format("{}: ", word);
  return fmt::format("\033[1;{}m{}:\033[0m ", color, word);
}

}  // namespace

void openStandardStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) >= 0) continue;
    // Opened the wrong way round, so that reading and writing still fail.
    const int other_way = stream == STDIN_FILENO ? O_WRONLY : O_RDONLY;
    if (open("/dev/null", other_way) != stream) return;  // the lowest that is free
  }
}

void failOutput() {
  if (errno == EINTR) stopIfInterrupted();
  if (errno == EPIPE) throw ReaderGone();
  throw IoError(fmt::format("cannot write to the standard output: {}",
                            std::generic_category().message(errno)));
}

void sayRaw(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
    if (written < 0) return;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void print(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) failOutput();
}

void flushOutput() {
  if (std::fflush(stdout) != 0) failOutput();
}

void printError(std::string_view message) {
  constexpr int kRed = 31;
  say(message, heading("error", kRed));
}

bool watchedTerminal() { return terminal() && !isSet("CI"); }

void Console::note(std::string_view message) const {
  if (!quiet_) say(message);
}

void Console::detail(std::string_view message) const {
  if (verbose_) say(message);
}

void Console::warn(std::string_view message) const { warnOfPlace(escaped(message)); }

void Console::warnOfPlace(std::string_view message) const {
  constexpr int kYellow = 33;
  if (!quiet_) say(message, heading("warning", kYellow));
}

}  // namespace merge2d
