#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/console.h"
#include "lessons/lesson.h"
#include "src2d/core/utf8.h"
#include "src2d/scene/load.h"

namespace merge2d {
namespace {

void list(const MessageOptions& options) {
  check(options);
  const std::vector<BuiltinScene> scenes = builtinScenes();
  const std::vector<BuiltinLesson> lessons = builtinLessons();
  if (options.json) {
    nlohmann::ordered_json out;
    out["scenes"] = nlohmann::ordered_json::array();
    out["lessons"] = nlohmann::ordered_json::array();
    for (const BuiltinScene& scene : scenes) {
      out["scenes"].push_back({{"name", scene.name}, {"title", scene.title}});
    }
    for (const BuiltinLesson& lesson : lessons) {
      out["lessons"].push_back({{"name", lesson.name}, {"title", lesson.title}});
    }
    print(out.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    return;
  }
  std::size_t width = 0;
  for (const BuiltinScene& scene : scenes) width = std::max(width, scene.name.size());
  for (const BuiltinLesson& lesson : lessons) width = std::max(width, lesson.name.size());
  print("Scenes:\n");
  for (const BuiltinScene& scene : scenes) {
    print(fmt::format("  {:<{}}  {}\n", escaped(scene.name), width, scene.title));
  }
  if (lessons.empty()) return;
  print("Lessons:\n");
  for (const BuiltinLesson& lesson : lessons) {
    print(fmt::format("  {:<{}}  {}\n", escaped(lesson.name), width, asOneLine(lesson.title)));
  }
}

}  // namespace

void addListCommand(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("list", "Name the built-in scenes and lessons");
  command->footer("Examples:\n  merge2d list\n  merge2d list --json");
  const auto options = std::make_shared<MessageOptions>();
  addMessageOptions(*command, *options);
  command->callback([&action, options] { action = [options] { list(*options); }; });
}

}  // namespace merge2d
