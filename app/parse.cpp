#include "app/parse.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/console.h"
#include "app/usage_error.h"
#include "src2d/core/suggest.h"
#include "src2d/scene/load.h"

namespace merge2d {
namespace {

std::vector<std::string> commandNames(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// "--steps", "-o", "--output", …
std::vector<std::string> optionNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

bool looksLikeOption(const std::string& word) { return word.size() > 1 && word.front() == '-'; }

/// `help run` means `run --help`; the command may come after options.
void bringCommandForward(std::vector<std::string>& arguments,
                         const std::vector<std::string>& commands) {
  if (arguments.empty()) return;
  if (arguments[0] == "help") {
    arguments.erase(arguments.begin());
    arguments.push_back("--help");
  } else if (looksLikeOption(arguments[0])) {
    const auto command = std::ranges::find_first_of(arguments, commands);
    if (command != arguments.end()) std::rotate(arguments.begin(), command, command + 1);
  }
}

bool isScene(const std::string& word) {
  const auto scenes = builtinScenes();
  const bool file = word.ends_with(".toml") || word.ends_with(".png");
  return file || std::ranges::any_of(scenes, [&](const auto& scene) { return scene.name == word; });
}

[[noreturn]] void failWithoutCommand(const CLI::App& program,
                                     const std::vector<std::string>& words) {
  const std::vector<std::string> commands = commandNames(program);
  if (words.empty()) {
    throw UsageError(fmt::format("a command is missing: {}", fmt::join(commands, ", ")));
  }
  const auto command = std::ranges::find_if_not(words, looksLikeOption);
  if (command == words.end()) {
    throw UsageError(
        fmt::format("unknown option '{}'{}", words[0], didYouMean(words[0], optionNames(program))));
  }
  if (isScene(*command)) {
    throw UsageError(
        fmt::format("'{}' is a scene, not a command; try 'merge2d run {}'", *command, *command));
  }
  const std::string near = didYouMean(*command, commands);
  throw UsageError(
      fmt::format("unknown command '{}'{}", *command,
                  near.empty() ? fmt::format(" (there are {})", fmt::join(commands, ", ")) : near));
}

/// A word that `command` could not make use of.
[[noreturn]] void failOfExtras(const CLI::App& program, const CLI::App& command,
                               const std::vector<std::string>& words) {
  const auto option = std::ranges::find_if(words, looksLikeOption);
  if (option == words.end()) {
    throw UsageError(fmt::format("unexpected argument '{}'", words[0]));
  }
  const std::string word = option->substr(0, option->find('='));
  const std::string here = didYouMean(word, optionNames(command));
  std::string elsewhere;
  for (const CLI::App* other : program.get_subcommands({})) {
    const std::string near(nearest(word, optionNames(*other)));
    if (contains(optionNames(*other), word)) {
      throw UsageError(fmt::format("'{}' is an option of {}, not of {}", word, other->get_name(),
                                   command.get_name()));
    }
    if (!near.empty()) elsewhere = fmt::format(" ('{}' is one of {})", near, other->get_name());
  }
  throw UsageError(fmt::format("unknown option '{}' of {}{}", word, command.get_name(),
                               here.empty() ? elsewhere : here));
}

/// "--steps needs a value" and the like, from CLI11's words for it.
std::string explained(const CLI::ParseError& error) {
  const std::string text = error.what();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) == nullptr) return text;
  const std::string option = text.substr(0, text.find(':'));
  const bool of_pair = option == "--pair" || option == "--weld";
  return fmt::format("{} needs {}", option, of_pair ? "the names of two bodies" : "a value");
}

}  // namespace

bool parse(CLI::App& program, std::vector<std::string> arguments) {
  bringCommandForward(arguments, commandNames(program));
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  const auto command = [&]() -> const CLI::App* {
    const auto parsed = program.get_subcommands();
    return parsed.empty() ? nullptr : parsed.front();
  };
  try {
    program.parse(std::move(arguments));
  } catch (const CLI::CallForVersion&) {
    print("merge2d " MERGE2D_VERSION "\n");
    return false;
  } catch (const CLI::CallForHelp&) {
    if (command() == nullptr && !program.remaining().empty()) {
      failWithoutCommand(program, program.remaining());
    }
    print(program.help());
    return false;
  } catch (const CLI::ExtrasError&) {
    if (command() == nullptr) failWithoutCommand(program, program.remaining());
    failOfExtras(program, *command(), program.remaining(true));
  } catch (const CLI::RequiredError& error) {
    // A mistyped option may be the reason, or words before the command.
    if (command() == nullptr) failWithoutCommand(program, program.remaining(true));
    const std::vector<std::string> extras = program.remaining(true);
    if (!extras.empty()) failOfExtras(program, *command(), extras);
    throw UsageError(
        fmt::format("{}: a built-in name (see 'merge2d list') or a file", error.what()));
  } catch (const CLI::ParseError& error) {
    throw UsageError(explained(error));
  }
  if (command() == nullptr) failWithoutCommand(program, {});
  return true;
}

}  // namespace merge2d
