#pragma once
/// From arguments to the command that is meant, with help for those who mistyped.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace merge2d {

/// Lets `program` parse the arguments: options may stand before the command, and `help` may be a
/// word. Returns false when the arguments ask for help or the version, which is printed. Throws
/// UsageError.
bool parse(CLI::App& program, std::vector<std::string> arguments);

}  // namespace merge2d
