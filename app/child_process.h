#pragma once
/// Other programs, run to their end.

#include <filesystem>
#include <string>
#include <vector>

namespace merge2d {

/// How a program ended.
struct ChildResult {
  int code = -1;         ///< what it returned; -1 when a signal ended it
  int signal = 0;        ///< that ended it
  std::string messages;  ///< the beginning of all that it wrote
};

/// Runs a program, whose first argument is its name. A signal that interrupts this program is
/// handed on to it, and it is killed where it does not end by that, or where this program is.
/// Throws IoError where it cannot be started, and Interrupted where both were.
ChildResult runChild(const std::filesystem::path& program, std::vector<std::string> arguments);

}  // namespace merge2d
