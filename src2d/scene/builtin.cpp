#include "src2d/scene/builtin.h"

#include <algorithm>
#include <cstdlib>

#include "src2d/scene/file.h"
#include "src2d/scene/load.h"
#include "src2d/scene/toml_parse.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

/// MERGE2D_SCENES of the environment, else the folder in the sources, else the installed one.
fs::path sceneFolder() {
  if (const char* chosen = std::getenv("MERGE2D_SCENES")) return chosen;
  std::error_code ignored;
  const fs::path source = MERGE2D_SCENES_SOURCE_DIR;
  return fs::is_directory(source, ignored) ? source : fs::path(MERGE2D_SCENES_INSTALL_DIR);
}

/// What the file says it is called; its name when it does not say, or is no scene.
std::string sceneTitle(const fs::path& path) {
  const std::string name = path.stem().string();
  try {
    const std::string text = readFile(path);
    return parseToml(SourceText(path.string(), text))["title"].value_or(name);
  } catch (const std::runtime_error&) {
    return name;
  }
}

}  // namespace

std::optional<fs::path> builtinScene(const std::string& name) {
  const bool plain = !name.empty() && fs::path(name).filename() == fs::path(name);
  const fs::path path = sceneFolder() / (name + ".toml");
  std::error_code ignored;
  if (plain && fs::is_regular_file(path, ignored)) return path;
  return std::nullopt;
}

std::vector<BuiltinScene> builtinScenes() {
  std::vector<BuiltinScene> scenes;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(sceneFolder(), ignored)) {
    if (entry.path().extension() != ".toml") continue;
    scenes.push_back({entry.path().stem().string(), sceneTitle(entry.path())});
  }
  std::sort(scenes.begin(), scenes.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  return scenes;
}

}  // namespace merge2d
