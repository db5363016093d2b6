#include "app/lesson_source.h"

#include <filesystem>

#include "lessons/lesson.h"

namespace merge2d {

namespace fs = std::filesystem;

std::optional<DataFolder> lessonNamed(const std::string& name) {
  for (const BuiltinLesson& lesson : builtinLessons()) {
    if (lesson.name == name) return lesson.folder;
  }
  if (fs::is_directory(name)) return DataFolder(fs::path(name));
  return std::nullopt;
}

Scene sceneOfLesson(const DataFolder& lesson, const Overrides& overrides) {
  const Lesson whole = loadLesson(lesson);  // whose error names the fault
  const std::string& scene = whole.traces.front().scene_name;
  Scene found =
      lesson.holds(scene) ? loadSceneFile(lesson, scene, overrides) : loadScene(scene, overrides);
  found.name = whole.name;
  found.duration = whole.traces.front().scene.duration;
  return found;
}

}  // namespace merge2d
