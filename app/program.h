#pragma once
/// The command line as a whole.

#include <string>
#include <vector>

namespace merge2d {

/// The exit codes of the program.
enum ExitCode : int {
  kFine = 0,
  kCheckFailed = 1,  ///< also: a simulation stopped being finite
  kWrongUsage = 2,
  kBadInput = 3,      ///< a scene, lesson or graph file
  kOutputFailed = 4,  ///< rendering, reading or writing
};

/// Runs one command: everything after the program's name. Returns an `ExitCode`.
int runProgram(std::vector<std::string> arguments);

}  // namespace merge2d
