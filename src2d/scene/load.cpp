#include "src2d/scene/load.h"

#include <fmt/format.h>

#include "src2d/core/error.h"
#include "src2d/scene/builtin.h"
#include "src2d/scene/image.h"
#include "src2d/scene/interpret.h"
#include "src2d/scene/override.h"
#include "src2d/scene/toml_parse.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

/// The file on disk of this path.
DataFile fileAt(const fs::path& path) { return {path.parent_path(), path.filename().string()}; }

/// The file of what the user called `name_or_path`: a built-in scene where it is the bare name of
/// one (`books`; a file of that name is `./books`), else a file as it is.
DataFile resolve(const std::string& name_or_path) {
  const fs::path path(name_or_path);
  const bool bare = !path.has_parent_path() && !path.has_extension();
  const auto builtin = builtinScene(name_or_path);
  std::error_code ignored;
  if (bare && builtin) return *builtin;
  if (fs::is_regular_file(path, ignored)) return fileAt(path);
  if (builtin) return *builtin;
  if (fs::is_directory(path, ignored)) {
    throw InputError(fmt::format("{} is a folder, not a scene", name_or_path));
  }
  if (!bare) throw InputError(fmt::format("there is no file {}", name_or_path));
  std::vector<std::string> names;
  for (const BuiltinScene& scene : builtinScenes()) names.push_back(scene.name);
  throw InputError(fmt::format("no built-in scene is called '{}'{}; `merge2d list` names them all",
                               name_or_path, didYouMean(name_or_path, names)));
}

/// A picture is no text, and what it is shows in its name.
void refusePicture(std::string_view bytes, const std::string& source) {
  const std::string_view kind = pictureKind(bytes);
  if (kind.empty()) return;
  if (kind == "PNG") {
    throw InputError(fmt::format(
        "{}: this is a PNG picture: the name of a drawn scene must end in .png", source));
  }
  throw InputError(
      fmt::format("{}: this is a {} picture: a drawn scene is a PNG picture, whose "
                  "name ends in .png",
                  source, kind));
}

void warnOfEmptiness(Scene& scene, const std::string& source) {
  if (scene.bodies.empty() && scene.emitters.empty()) {
    scene.warnings.push_back(fmt::format("{}: the scene has no bodies", source));
  }
}

}  // namespace

Scene parseScene(std::string_view toml, const std::string& source, const Overrides& overrides) {
  const SourceText text(source, toml);
  toml::table table = parseToml(text);
  for (const auto& [key, value] : overrides) applyOverride(table, key, value);

  TableReader root(text, table, "the scene");
  Scene scene;
  scene.name = scene.title = fs::path(source).stem().string();
  readWorld(root, scene);
  readSettings(root, scene.settings);
  const BodyNames names = readBodies(root, scene);
  readEmitters(root, scene);
  readActions(root, scene, names);
  readJoints(root, scene, names);
  root.done();
  warnOfEmptiness(scene, source);
  return scene;
}

Scene loadScene(const std::string& name_or_path, const Overrides& overrides) {
  const DataFile found = resolve(name_or_path);
  return loadSceneFile(found.folder, found.name, overrides);
}

Scene loadSceneFile(const DataFolder& folder, const std::string& file, const Overrides& overrides) {
  const fs::path path = folder.pathOf(file);
  if (!folder.isEmbedded() && path.extension() == ".png") return loadDrawing(path, overrides);
  const std::string text = folder.read(file);
  refusePicture(text, path.string());
  return parseScene(text, path.string(), overrides);
}

}  // namespace merge2d
