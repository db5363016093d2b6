#include <fmt/format.h>
#include <unistd.h>

#include <iostream>
#include <memory>

#include "app/commands.h"
#include "app/console.h"
#include "app/json.h"
#include "app/line_editor.h"
#include "app/picture_file.h"
#include "app/render_options.h"
#include "app/simulation.h"
#include "app/stage_pictures.h"
#include "app/usage_error.h"
#include "lessons/player.h"
#include "src2d/core/error.h"

namespace merge2d {
namespace {

constexpr const char* kStepExamples = R"(Examples:
  merge2d step books
  printf 'event merge\ntable\nwhy\n' | merge2d step books
  printf 'jump 20 Unmerge\npicture unmerge.png\n' | merge2d step tower-platform

'help' lists the commands: by step, by stage of the algorithm, or to the next event, and back; tables, reasons, pictures.
In a terminal the line can be edited, Tab completes, the arrow keys recall. From a pipe each line is a command, and is
repeated in the output; the exit code is 2 when one was not understood. With --json each command is answered by an
object in a line: where the walk is then, whether the command could be done, and the text.)";

/// An answer for programs, in a line.
std::string asJson(Player& player, const std::string& command, const Answer& answer) {
  const Json out{{"command", command},
                 {"ok", answer.ok},
                 {"step", player.step()},
                 {"time", player.time()},
                 {"stage", name(player.stage())},
                 {"text", answer.text}};
  return out.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Lines from a pipe.
int followScript(Player& player, bool json) {
  int failed = 0;
  for (std::string line; !player.done() && std::getline(std::cin, line);) {
    if (!json) print(player.prompt() + line + "\n");
    const Answer answer = player.run(line);
    print(json ? asJson(player, line, answer) : answer.text);
    if (json) flushOutput();  // a program may wait for it before it asks on
    failed += answer.ok ? 0 : 1;
  }
  return failed;
}

/// Lines from a person.
void talk(Player& player) {
  LineEditor editor([&player](const std::string& line) { return player.completions(line); });
  while (!player.done()) {
    flushOutput();
    const std::optional<std::string> line = editor.read(player.prompt());
    if (!line) return print("\n");
    print(player.run(*line).text);
  }
}

/// In a dialogue a refusal is an answer, and not the end.
void requireMayAppear(const std::string& picture, bool force) {
  try {
    requirePictureMayAppear(picture, force);
  } catch (const UsageError& error) {
    throw IoError(error.what());
  }
}

void step(const SceneOptions& options) {
  check(options);
  const Console console(options);
  const Scene scene = loadScene(options, console);
  StagePictures pictures(scene, options.mode);
  Player player(scene, options.mode, stepCount(scene),
                [&](const StepRecord* record, Stage stage, const std::string& file) {
                  requireMayAppear(file, options.force);
                  return pictures.save(record, stage, file);
                });
  if (options.json) {
    print(asJson(player, "", {.text = player.greeting()}));
    flushOutput();
  } else {
    print(player.greeting());
    if (isatty(STDIN_FILENO) == 1 && isatty(STDOUT_FILENO) == 1) return talk(player);
  }
  const int failed = followScript(player, options.json);
  if (failed > 0) {
    throw UsageError(fmt::format("{} could not be done",
                                 failed == 1 ? "a command" : fmt::format("{} commands", failed)));
  }
}

}  // namespace

void addStepCommand(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand(
      "step", "Walk through a scene: by step, by stage of the algorithm, by event, and back");
  command->footer(kStepExamples);
  const auto options = std::make_shared<SceneOptions>();
  addSceneOptions(*command, *options);
  addContextOption(*command);
  addGeneralOptions(*command, *options);
  command->callback([&action, options] { action = [options] { step(*options); }; });
}

}  // namespace merge2d
