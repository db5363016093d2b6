#pragma once
/// The options that commands share, and how single options are read.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "src2d/scene/load.h"
#include "src2d/scene/settings.h"

namespace merge2d {

/// How much a command says.
struct MessageOptions {
  bool json = false;
  bool quiet = false;
  bool verbose = false;
};

/// The options of every command that takes a scene.
struct SceneOptions : MessageOptions {
  std::string scene;                  ///< a built-in name or a file
  Overrides overrides;                ///< --set and --seed
  std::optional<std::int64_t> steps;  ///< --steps
  std::optional<double> seconds;      ///< --seconds
  Mode mode = Mode::MergeSleep;
  bool has_mode = false;  ///< --mode was given
  bool force = false;
};

/// The scene and how it is simulated; a command's own options come next in its help, and then:
void addSceneOptions(CLI::App& command, SceneOptions& options);
/// --force and what `addMessageOptions` adds.
void addGeneralOptions(CLI::App& command, SceneOptions& options);
void addMessageOptions(CLI::App& command, MessageOptions& options);

/// Throws UsageError for options that contradict each other.
void check(const MessageOptions& options);
void check(const SceneOptions& options);

/// Adds an option whose text `read` turns into a value. `read` throws UsageError; of several
/// occurrences the last one counts.
CLI::Option* addOption(CLI::App& command, const std::string& names, const std::string& value_name,
                       const std::function<void(const std::string&)>& read,
                       const std::string& help);

/// The same for where something is written: named twice, one of both would be missed, so that this
/// is a UsageError.
CLI::Option* addOutputOption(CLI::App& command, const std::string& names,
                             const std::string& value_name,
                             const std::function<void(const std::string&)>& read,
                             const std::string& help);

/// A whole number from `least` to `most`; otherwise a UsageError that names `option`.
std::int64_t readInteger(const std::string& option, const std::string& text, std::int64_t least,
                         std::int64_t most);
/// A finite number of `least` or more.
double readNumber(const std::string& option, const std::string& text, double least);
/// The name of a file or folder, which cannot be empty, nor an option that was meant as such.
std::string readPath(const std::string& option, const std::string& text);

}  // namespace merge2d
