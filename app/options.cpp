#include "app/options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

#include "app/memory_limit.h"
#include "app/simulation.h"
#include "app/usage_error.h"
#include "src2d/core/suggest.h"
#include "src2d/scene/names.h"

namespace merge2d {
namespace {

constexpr const char* kGeneral = "General";

Mode readMode(const std::string& text) {
  if (const auto mode = valueOf<Mode>(text)) return *mode;
  throw UsageError(fmt::format("--mode must be one of {}, but is '{}'{}",
                               fmt::join(namesOf<Mode>(), ", "), text,
                               didYouMean(text, namesOf<Mode>())));
}

void readOverride(const std::string& text, Overrides& overrides) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos) {
    throw UsageError(fmt::format(
        "--set needs key=value, such as --set merging.velocity=0.02, but got '{}'", text));
  }
  overrides.emplace_back(text.substr(0, equals), text.substr(equals + 1));
}

void addSimulationOptions(CLI::App& command, SceneOptions& options) {
  constexpr const char* kGroup = "Simulation";
  addOption(
      command, "--steps", "N",
      [&](const std::string& s) { options.steps = readInteger("--steps", s, 0, kMostSteps); },
      "Number of time steps (default: the scene's duration)")
      ->group(kGroup);
  addOption(
      command, "--seconds", "T",
      [&](const std::string& s) { options.seconds = readNumber("--seconds", s, 0.0); },
      "Simulated time in seconds, instead of --steps")
      ->group(kGroup);
  addOption(
      command, "--mode", "MODE",
      [&](const std::string& s) {
        options.mode = readMode(s);
        options.has_mode = true;
      },
      "reference, sleep, merge or merge+sleep (default)")
      ->group(kGroup);
  command
      .add_option_function<std::vector<std::string>>(
          "--set",
          [&](const std::vector<std::string>& all) {
            for (const std::string& one : all) readOverride(one, options.overrides);
          },
          "Change a parameter of the scene, such as merging.velocity=0.02 or "
          "body.ball.mass=50; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->group(kGroup);
  addOption(
      command, "--seed", "N",
      [&](const std::string& s) {
        const auto seed = readInteger("--seed", s, 0, std::numeric_limits<std::int64_t>::max());
        options.overrides.emplace_back("seed", std::to_string(seed));
      },
      "Seed of everything random in the scene")
      ->group(kGroup);
  addOption(
      command, "--memory-limit", "SIZE",
      [](const std::string& s) { limitMemory(readMemory("--memory-limit", s)); },
      "End with an error where the data need more memory, such as 2GB (default: 75% of the "
      "machine)")
      ->group(kGroup);
}

}  // namespace

CLI::Option* addOption(CLI::App& command, const std::string& names, const std::string& value_name,
                       const std::function<void(const std::string&)>& read,
                       const std::string& help) {
  return command.add_option_function<std::string>(names, read, help)
      ->type_name(value_name)
      ->take_last();
}

CLI::Option* addOutputOption(CLI::App& command, const std::string& names,
                             const std::string& value_name,
                             const std::function<void(const std::string&)>& read,
                             const std::string& help) {
  const std::string option = names.substr(names.rfind(',') + 1);
  const auto once = [option, read](const std::vector<std::string>& all) {
    if (all.size() > 1) {
      throw UsageError(
          fmt::format("{} names both '{}' and '{}': name one output", option, all[0], all[1]));
    }
    read(all.front());
  };
  return command.add_option_function<std::vector<std::string>>(names, once, help)
      ->type_name(value_name)
      ->allow_extra_args(false);
}

std::int64_t readInteger(const std::string& option, const std::string& text, std::int64_t least,
                         std::int64_t most) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  if (!whole || value < least || value > most) {
    throw UsageError(fmt::format("{} must be a whole number from {} to {}, but is '{}'", option,
                                 least, most, text));
  }
  return value;
}

double readNumber(const std::string& option, const std::string& text, double least) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  if (!whole || !std::isfinite(value) || value < least) {
    throw UsageError(
        fmt::format("{} must be a number of {} or more, but is '{}'", option, least, text));
  }
  return value;
}

std::string readPath(const std::string& option, const std::string& text) {
  if (text.empty() || (text.size() > 1 && text.front() == '-')) {
    throw UsageError(
        fmt::format("{} needs the name of a file or folder, but got '{}'", option, text));
  }
  return text;
}

void addMessageOptions(CLI::App& command, MessageOptions& options) {
  command.add_flag("--json", options.json, "Print the result as JSON")->group(kGeneral);
  command.add_flag("--quiet", options.quiet, "No messages but errors")->group(kGeneral);
  command.add_flag("--verbose", options.verbose, "More messages")->group(kGeneral);
  command.set_help_flag("-h,--help", "Print this help and exit")->group(kGeneral);
}

void addSceneOptions(CLI::App& command, SceneOptions& options) {
  command
      .add_option(
          "SCENE", options.scene,
          "A built-in scene or lesson (see merge2d list), a .toml file, or a drawn .png file")
      ->type_name("")
      ->required();
  addSimulationOptions(command, options);
}

void addGeneralOptions(CLI::App& command, SceneOptions& options) {
  command.add_flag("--force", options.force, "Overwrite files that are not ours")->group(kGeneral);
  addMessageOptions(command, options);
}

void check(const MessageOptions& options) {
  if (options.quiet && options.verbose) {
    throw UsageError("--quiet and --verbose exclude each other");
  }
}

void check(const SceneOptions& options) {
  check(static_cast<const MessageOptions&>(options));
  if (options.steps && options.seconds) {
    throw UsageError("--steps and --seconds both say how long to simulate; give one of them");
  }
}

}  // namespace merge2d
