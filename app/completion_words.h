#pragma once
/// The commands and options of this program as shells are told about them.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace merge2d {

struct OptionWords {
  std::vector<std::string> names{};  ///< "-o", "--output"
  std::string help{};                ///< in one line
  bool takes_value = false;          ///< false: a switch
  bool takes_folder = false, takes_file = false;
  std::vector<std::string> choices{};  ///< the words that may follow, or empty
  bool begins_only = false;            ///< the choices are beginnings: "merging.velocity="
};

/// An argument of a command line without an option before it.
enum class Argument { None, Scene, File, Shell, Command };

struct CommandWords {
  std::string name{}, help{};
  std::vector<OptionWords> options{};
  Argument argument = Argument::None;
};

/// All commands that `--help` lists, and `help` itself.
std::vector<CommandWords> commandWordsOf(const CLI::App& program);

}  // namespace merge2d
