#include "app/completion_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "render/overlays.h"
#include "src2d/scene/settings_list.h"

namespace merge2d {
namespace {

std::string inOneLine(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

std::vector<std::string> split(std::string_view text, char at) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    if (c == at) {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

std::vector<std::string> overlayNames() {
  std::vector<std::string> names = {"none"};
  for (const OverlayEntry& entry : kOverlayTable) names.emplace_back(entry.name);
  return names;
}

/// "merging.velocity=" and its like, and the keys of a scene itself.
std::vector<std::string> settingKeys() {
  std::vector<std::string> keys = {"gravity=", "step=", "duration="};
  Settings settings;
  forEachSetting(settings,
                 [&](std::string_view table, std::string_view key, const auto&, const Range&) {
                   keys.push_back(fmt::format("{}.{}=", table, key));
                 });
  return keys;
}

/// The words that may follow an option; those of `l|m|h` say it themselves.
std::vector<std::string> choicesOf(const std::string& option, const std::string& type) {
  if (type.find('|') != std::string::npos) return split(type, '|');
  if (option == "--mode") return {"reference", "sleep", "merge", "merge+sleep"};
  if (option == "--theme") return {"light", "dark", "print"};
  if (option == "--format") return {"png", "svg", "apng", "gif", "mp4"};
  if (option == "--overlay") return overlayNames();
  if (option == "--set") return settingKeys();
  return {};
}

OptionWords wordsOf(const CLI::Option& option) {
  OptionWords words{.help = inOneLine(option.get_description())};
  for (const std::string& name : option.get_snames()) words.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) words.names.push_back("--" + name);
  words.takes_value = option.get_items_expected_max() > 0;
  if (!words.takes_value) return words;
  const std::string type = option.get_type_name();
  words.takes_folder = type == "DIR";
  words.takes_file = type.starts_with("FILE");
  words.choices = choicesOf(words.names.back(), type);
  words.begins_only = words.names.back() == "--set";
  return words;
}

Argument argumentOf(const CLI::Option& positional) {
  const std::string name = positional.get_name();
  if (name == "SHELL") return Argument::Shell;
  return name == "FILE" ? Argument::File : Argument::Scene;
}

}  // namespace

std::vector<CommandWords> commandWordsOf(const CLI::App& program) {
  std::vector<CommandWords> commands;
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_group().empty()) continue;
    CommandWords words{.name = command->get_name(), .help = inOneLine(command->get_description())};
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_positional()) {
        words.argument = argumentOf(*option);
      } else if (!option->get_group().empty()) {
        words.options.push_back(wordsOf(*option));
      }
    }
    commands.push_back(std::move(words));
  }
  commands.push_back(
      {.name = "help", .help = "Tell how a command is used", .argument = Argument::Command});
  return commands;
}

}  // namespace merge2d
