#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/usage_error.h"
#include "src2d/core/suggest.h"

namespace merge2d {
namespace {

constexpr const char* kCompletionExamples = R"(Examples:
  merge2d completion bash > ~/.local/share/bash-completion/completions/merge2d
  merge2d completion zsh > ~/.zfunc/_merge2d
  merge2d completion fish > ~/.config/fish/completions/merge2d.fish

An installed merge2d has these files in place already.)";

constexpr std::array<std::string_view, 3> kShells = {"bash", "zsh", "fish"};

/// The words that may follow an option; others are file names or anything.
constexpr std::pair<std::string_view, std::string_view> kChoices[] = {
    {"--mode", "reference sleep merge merge+sleep"},
    {"--theme", "light dark print"},
    {"--format", "png svg apng gif mp4"},
    {"--context", "osmesa egl"},
    {"--quality", "l m h p k"},
    {"-q", "l m h p k"},
};

/// Prints the names of the scenes and lessons, for a shell.
constexpr const char* kNames = R"(merge2d list 2>/dev/null | sed -n 's/^  \([^ ]*\) .*/\1/p')";

/// An option as shells are told about it.
struct OptionWords {
  std::vector<std::string> names{};  ///< "-o", "--output"
  std::string help{};                ///< in one line
  bool takes_value = false;
  bool takes_folder = false, takes_file = false;
  std::string_view choices{};  ///< or empty
};

struct CommandWords {
  std::string name{}, help{};
  std::vector<OptionWords> options{};
  bool takes_scene = false;
};

std::string inOneLine(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

OptionWords wordsOf(const CLI::Option& option) {
  OptionWords words{.help = inOneLine(option.get_description())};
  for (const std::string& name : option.get_snames()) words.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) words.names.push_back("--" + name);
  words.takes_value = option.get_type_size() != 0;
  const std::string type = option.get_type_name();
  words.takes_folder = type == "DIR";
  words.takes_file = type.starts_with("FILE");
  for (const auto& [name, choices] : kChoices) {
    if (std::ranges::find(words.names, name) != words.names.end()) words.choices = choices;
  }
  return words;
}

std::vector<CommandWords> commandsOf(const CLI::App& program) {
  std::vector<CommandWords> commands;
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_group().empty()) continue;
    CommandWords words{.name = command->get_name(), .help = inOneLine(command->get_description())};
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_positional()) {
        words.takes_scene = option->get_name() != "SHELL";
      } else if (!option->get_group().empty()) {
        words.options.push_back(wordsOf(*option));
      }
    }
    commands.push_back(std::move(words));
  }
  return commands;
}

std::string bashScript(const std::vector<CommandWords>& commands) {
  std::string names, cases, values;
  for (const CommandWords& command : commands) {
    names += (names.empty() ? "" : " ") + command.name;
    std::string options;
    for (const OptionWords& option : command.options) {
      options += fmt::format("{}{}", options.empty() ? "" : " ", fmt::join(option.names, " "));
      if (!option.takes_value) continue;
      std::string words = "return";
      if (!option.choices.empty()) {
        words = fmt::format("COMPREPLY=($(compgen -W \"{}\" -- \"$cur\")); return", option.choices);
      }
      if (option.takes_folder) words = "COMPREPLY=($(compgen -d -- \"$cur\")); return";
      if (option.takes_file) words = "COMPREPLY=($(compgen -f -- \"$cur\")); return";
      for (const std::string& name : option.names) {
        values += fmt::format("    {}:{}) {} ;;\n", command.name, name, words);
      }
    }
    cases += fmt::format("    {}) options=\"{}\" ;;\n", command.name, options);
  }
  return fmt::format(R"sh(# bash completion for merge2d, written by `merge2d completion bash`
_merge2d() {{
  local cur="${{COMP_WORDS[COMP_CWORD]}}" prev="${{COMP_WORDS[COMP_CWORD-1]}}"
  local command="" options="" i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    if [[ "${{COMP_WORDS[i]}}" != -* ]]; then command="${{COMP_WORDS[i]}}"; break; fi
  done
  if [[ -z "$command" ]]; then
    COMPREPLY=($(compgen -W "{0} --help --version" -- "$cur"))
    return
  fi
  case "$command:$prev" in
{1}  esac
  case "$command" in
{2}  esac
  if [[ "$cur" == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$cur"))
  elif [[ "$command" == completion ]]; then
    COMPREPLY=($(compgen -W "{3}" -- "$cur"))
  else
    COMPREPLY=($(compgen -W "$({4})" -- "$cur") $(compgen -f -- "$cur"))
  fi
}}
complete -o filenames -F _merge2d merge2d
)sh",
                     names, values, cases, fmt::join(kShells, " "), kNames);
}

/// Text inside of single quotes of a shell, without characters that `_arguments` takes as its own.
std::string zshText(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'') {
      out += "'\\''";
    } else if (c == '[' || c == ']' || c == ':') {
      out += std::string("\\") + c;
    } else {
      out += c;
    }
  }
  return out;
}

std::string zshScript(const std::vector<CommandWords>& commands) {
  std::string names, cases;
  for (const CommandWords& command : commands) {
    names += fmt::format("    '{}:{}'\n", command.name, zshText(command.help));
    cases += fmt::format("    {}) _arguments \\\n", command.name);
    for (const OptionWords& option : command.options) {
      std::string value;
      if (option.takes_value) value = ":value:";
      if (!option.choices.empty()) value = fmt::format(":value:({})", option.choices);
      if (option.takes_folder) value = ":folder:_files -/";
      if (option.takes_file) value = ":file:_files";
      for (const std::string& name : option.names) {
        cases += fmt::format("      '*{}[{}]{}' \\\n", name, zshText(option.help), value);
      }
    }
    if (command.name == "completion") {
      cases += fmt::format("      '1:shell:({})' ;;\n", fmt::join(kShells, " "));
    } else {
      cases += command.takes_scene ? "      '*:scene:_merge2d_scenes' ;;\n"
                                   : "      '*::nothing: ' ;;\n";
    }
  }
  return fmt::format(R"sh(#compdef merge2d
# zsh completion for merge2d, written by `merge2d completion zsh`
_merge2d_scenes() {{
  local -a names
  names=(${{(f)"$({0})"}})
  _alternative 'scenes:scene:compadd -a names' 'files:file:_files'
}}
_merge2d() {{
  local -a commands
  commands=(
{1}  )
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  local command="$words[2]"
  shift words
  (( CURRENT-- ))
  case "$command" in
{2}  esac
}}
_merge2d "$@"
)sh",
                     kNames, names, cases);
}

std::string fishText(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  return "'" + out + "'";
}

std::string fishScript(const std::vector<CommandWords>& commands) {
  std::string out = "# fish completion for merge2d, written by `merge2d completion fish`\n";
  for (const CommandWords& command : commands) {
    out += fmt::format("complete -c merge2d -n __fish_use_subcommand -f -a {} -d {}\n",
                       command.name, fishText(command.help));
    const std::string here =
        fmt::format("complete -c merge2d -n '__fish_seen_subcommand_from {}'", command.name);
    if (command.name == "completion") {
      out += fmt::format("{} -f -a '{}'\n", here, fmt::join(kShells, " "));
    } else if (command.takes_scene) {
      out += fmt::format("{} -a {}\n", here, fishText(fmt::format("({})", kNames)));
    }
    for (const OptionWords& option : command.options) {
      out += here;
      for (const std::string& name : option.names) {
        out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      }
      if (option.takes_value) out += option.takes_file || option.takes_folder ? " -r" : " -x";
      if (!option.choices.empty()) out += fmt::format(" -a '{}'", option.choices);
      out += " -d " + fishText(option.help) + "\n";
    }
  }
  return out;
}

void complete(const CLI::App& program, const std::string& shell) {
  if (shell.empty()) {
    throw UsageError(fmt::format("completion needs a shell: {}", fmt::join(kShells, ", ")));
  }
  const std::vector<CommandWords> commands = commandsOf(program);
  if (shell == "bash") return print(bashScript(commands));
  if (shell == "zsh") return print(zshScript(commands));
  if (shell == "fish") return print(fishScript(commands));
  throw UsageError(fmt::format("completion knows {}, but not '{}'{}", fmt::join(kShells, ", "),
                               shell, didYouMean(shell, kShells)));
}

}  // namespace

void addCompletionCommand(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("completion", "Print what completes commands in a shell");
  command->footer(kCompletionExamples);
  const auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "bash, zsh or fish")->type_name("");
  command->set_help_flag("-h,--help", "Print this help and exit")->group("General");
  command->callback(
      [&action, &program, shell] { action = [&program, shell] { complete(program, *shell); }; });
}

}  // namespace merge2d
