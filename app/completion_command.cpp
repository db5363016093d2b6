#include <fmt/format.h>

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands.h"
#include "app/completion_words.h"
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

/// Prints the names of the scenes and lessons, for a shell.
constexpr const char* kNames = R"(merge2d list 2>/dev/null | sed -n 's/^  \([^ ]*\) .*/\1/p')";

std::string commandNames(const std::vector<CommandWords>& commands) {
  std::string names;
  for (const CommandWords& command : commands) {
    names += (names.empty() ? "" : " ") + command.name;
  }
  return names;
}

/// How bash completes the value of an option.
std::string bashValue(const OptionWords& option) {
  if (option.takes_folder) return "COMPREPLY=($(compgen -d -- \"$cur\")); return";
  if (option.takes_file) return "COMPREPLY=($(compgen -f -- \"$cur\")); return";
  if (option.choices.empty()) return "return";
  return fmt::format("COMPREPLY=($(compgen -W \"{}\" -- \"$cur\")); {}return",
                     fmt::join(option.choices, " "),
                     option.begins_only ? "compopt -o nospace 2>/dev/null; " : "");
}

/// How bash completes an argument of a command.
std::string bashArgument(Argument argument, const std::string& names) {
  switch (argument) {
    case Argument::None:
      return "";
    case Argument::Scene:
      return fmt::format(
          "COMPREPLY=($(compgen -W \"$({})\" -- \"$cur\") $(compgen -f -- \"$cur\"))", kNames);
    case Argument::File:
      return "COMPREPLY=($(compgen -f -- \"$cur\"))";
    case Argument::Shell:
      return fmt::format("COMPREPLY=($(compgen -W \"{}\" -- \"$cur\"))", fmt::join(kShells, " "));
    case Argument::Command:
      return fmt::format("COMPREPLY=($(compgen -W \"{}\" -- \"$cur\"))", names);
  }
  return "";
}

std::string bashScript(const std::vector<CommandWords>& commands) {
  const std::string names = commandNames(commands);
  std::string cases, values, arguments;
  for (const CommandWords& command : commands) {
    std::string options;
    for (const OptionWords& option : command.options) {
      options += fmt::format("{}{}", options.empty() ? "" : " ", fmt::join(option.names, " "));
      if (!option.takes_value) continue;
      for (const std::string& name : option.names) {
        values += fmt::format("    {}:{}) {} ;;\n", command.name, name, bashValue(option));
      }
    }
    cases += fmt::format("    {}) options=\"{}\" ;;\n", command.name, options);
    arguments +=
        fmt::format("    {}) {} ;;\n", command.name, bashArgument(command.argument, names));
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
  # bash takes "=" for a word of its own.
  if [[ "$cur" == "=" ]]; then
    cur=""
    [[ "$prev" == -* ]] || return
  elif [[ "$prev" == "=" ]]; then
    prev="${{COMP_WORDS[COMP_CWORD-2]}}"
    [[ "$prev" == -* ]] || return
  fi
  case "$command:$prev" in
{1}  esac
  case "$command" in
{2}  esac
  if [[ "$cur" == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$cur"))
    return
  fi
  case "$command" in
{3}  esac
}}
complete -o filenames -F _merge2d merge2d
)sh",
                     names, values, cases, arguments);
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

/// How zsh completes the value of an option.
std::string zshValue(const OptionWords& option) {
  if (!option.takes_value) return "";
  if (option.takes_folder) return ":folder:_files -/";
  if (option.takes_file) return ":file:_files";
  if (option.choices.empty()) return ":value:";
  if (!option.begins_only) return fmt::format(":value:({})", fmt::join(option.choices, " "));
  return fmt::format(":value:{{compadd -S \"\" -- {}}}", fmt::join(option.choices, " "));
}

/// How zsh completes the arguments of a command.
std::string zshArgument(Argument argument, const std::string& names) {
  switch (argument) {
    case Argument::None:
      return "*::nothing: ";
    case Argument::Scene:
      return "*:scene:_merge2d_scenes";
    case Argument::File:
      return "*:file:_files";
    case Argument::Shell:
      return fmt::format("1:shell:({})", fmt::join(kShells, " "));
    case Argument::Command:
      return fmt::format("1:command:({})", names);
  }
  return "";
}

std::string zshScript(const std::vector<CommandWords>& commands) {
  const std::string all = commandNames(commands);
  std::string names, cases;
  for (const CommandWords& command : commands) {
    names += fmt::format("    '{}:{}'\n", command.name, zshText(command.help));
    cases += fmt::format("    {}) _arguments \\\n", command.name);
    for (const OptionWords& option : command.options) {
      for (const std::string& name : option.names) {
        cases +=
            fmt::format("      '*{}[{}]{}' \\\n", name, zshText(option.help), zshValue(option));
      }
    }
    cases += fmt::format("      '{}' ;;\n", zshArgument(command.argument, all));
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
    if (command.argument == Argument::Shell) {
      out += fmt::format("{} -f -a '{}'\n", here, fmt::join(kShells, " "));
    } else if (command.argument == Argument::Command) {
      out += fmt::format("{} -f -a '{}'\n", here, commandNames(commands));
    } else if (command.argument == Argument::Scene) {
      out += fmt::format("{} -a {}\n", here, fishText(fmt::format("({})", kNames)));
    }
    for (const OptionWords& option : command.options) {
      out += here;
      for (const std::string& name : option.names) {
        out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      }
      if (option.takes_value) out += option.takes_file || option.takes_folder ? " -r" : " -x";
      if (!option.choices.empty()) {
        out += fmt::format(" -a '{}'", fmt::join(option.choices, " "));
      }
      out += " -d " + fishText(option.help) + "\n";
    }
  }
  return out;
}

void complete(const CLI::App& program, const std::string& shell) {
  if (shell.empty()) {
    throw UsageError(fmt::format("completion needs a shell: {}", fmt::join(kShells, ", ")));
  }
  const std::vector<CommandWords> commands = commandWordsOf(program);
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
