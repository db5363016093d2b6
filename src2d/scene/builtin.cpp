#include "src2d/scene/builtin.h"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "src2d/core/utf8.h"
#include "src2d/scene/builtin_title.h"
#include "src2d/scene/load.h"

namespace merge2d {
namespace {

constexpr std::string_view kEnding = ".toml";

std::vector<DataFolder> sceneFolders() {
  return dataFolders("scenes", "MERGE2D_SCENES", embeddedScenes());
}

/// The title that a file gives; its name where there is none, or where it is no scene.
std::string sceneTitle(const DataFolder& folder, const std::string& file, const std::string& name) {
  try {
    return asOneLine(titleOf(folder, file, embeddedScenes()).value_or(name));
  } catch (const std::runtime_error&) {
    return name;
  }
}

}  // namespace

std::optional<DataFile> builtinScene(const std::string& name) {
  const bool plain =
      !name.empty() && std::filesystem::path(name).filename() == std::filesystem::path(name);
  if (!plain) return std::nullopt;
  const std::string file = name + std::string(kEnding);
  for (const DataFolder& folder : sceneFolders()) {
    if (folder.holds(file)) return DataFile{folder, file};
  }
  return std::nullopt;
}

std::vector<BuiltinScene> builtinScenes() {
  std::map<std::string, std::string> titles;  // by name
  for (const DataFolder& folder : sceneFolders()) {
    for (const std::string& file : folder.entries()) {
      if (!file.ends_with(kEnding)) continue;
      const std::string name = file.substr(0, file.size() - kEnding.size());
      if (!titles.contains(name)) titles[name] = sceneTitle(folder, file, name);
    }
  }
  std::vector<BuiltinScene> scenes;
  for (const auto& [name, title] : titles) scenes.push_back({name, title});
  return scenes;
}

}  // namespace merge2d
