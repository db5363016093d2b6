#include "src2d/scene/load.h"

#include <fmt/format.h>

#include "src2d/core/error.h"
#include "src2d/scene/builtin.h"
#include "src2d/scene/crowd.h"
#include "src2d/scene/file.h"
#include "src2d/scene/image.h"
#include "src2d/scene/interpret.h"
#include "src2d/scene/override.h"
#include "src2d/scene/toml_parse.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

/// The file on disk of this path.
DataFile fileAt(const fs::path& path) { return {path.parent_path(), path.filename().string()}; }

/// Complains of a file that is there, but may not be looked at.
void failAccess(const fs::path& path) {
  std::error_code error;
  static_cast<void>(fs::status(path, error));
  const bool missing = !error || error == std::errc::no_such_file_or_directory;
  if (!missing) throw IoError(fmt::format("{}: {}", path.string(), error.message()));
}

/// The name of a scene from that source.
std::string sceneName(const std::string& source) {
  if (source == kStandardInput) return "stdin";
  return asOneLine(fs::path(source).stem().string());
}

/// The file of what the user called `name_or_path`: a built-in scene where it is the bare name of
/// one (`books`; a file of that name is `./books`), else a file as it is.
DataFile resolve(const std::string& name_or_path) {
  const fs::path path(name_or_path);
  const bool bare = !path.has_parent_path() && !path.has_extension();
  const auto builtin = builtinScene(name_or_path);
  std::error_code ignored;
  if (bare && builtin) return *builtin;
  const fs::file_status status = fs::status(path, ignored);
  if (isStandardInput(path) || (fs::exists(status) && !fs::is_directory(status))) {
    return fileAt(path);
  }
  if (builtin) return *builtin;
  if (fs::is_directory(status)) {
    throw InputError(fmt::format("{} is a folder, not a scene", name_or_path));
  }
  failAccess(path);
  if (!bare) throw InputError(fmt::format("there is no file {}", name_or_path));
  std::vector<std::string> names;
  for (const BuiltinScene& scene : builtinScenes()) names.push_back(scene.name);
  throw InputError(fmt::format("no built-in scene is called '{}'{}; `merge2d list` names them all",
                               name_or_path, didYouMean(name_or_path, names)));
}

/// A picture is no text, and its kind shows in its name, where it has one.
void refusePicture(std::string_view kind, const std::string& source) {
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

/// Complains of a crowd at the table that makes it.
void refuseCrowds(TableReader& root, const Scene& scene, const std::string& source) {
  const auto crowd = findCrowd(scene);
  if (!crowd) return;
  const std::string_view name = std::string_view(crowd->body).substr(0, crowd->body.find('['));
  for (const char* kind : {"body", "emitter"}) {
    for (TableReader& table : root.tables(kind)) {
      const auto given = table.get("name");
      if (given && given->text() == name) table.failAt(crowd->key, crowd->sentence);
    }
  }
  throw InputError(fmt::format("{}: {}", source, crowd->sentence));
}

}  // namespace

Scene parseScene(std::string_view toml, const std::string& source, const Overrides& overrides) {
  const SourceText text(source, toml);
  toml::table table = parseToml(text);
  for (const auto& [key, value] : overrides) applyOverride(table, key, value);

  TableReader root(text, table, "the scene");
  Scene scene;
  scene.name = scene.title = sceneName(source);
  readWorld(root, scene);
  readSettings(root, scene.settings);
  const BodyNames names = readBodies(root, scene);
  readCamera(root, scene, names);
  readEmitters(root, scene);
  readActions(root, scene, names);
  readJoints(root, scene, names);
  root.done();
  refuseCrowds(root, scene, source);
  warnOfEmptiness(scene, source);
  return scene;
}

Scene loadScene(const std::string& name_or_path, const Overrides& overrides) {
  const DataFile found = resolve(name_or_path);
  return loadSceneFile(found.folder, found.name, overrides);
}

Scene loadSceneFile(const DataFolder& folder, const std::string& file, const Overrides& overrides) {
  const fs::path path = folder.pathOf(file);
  const std::string bytes = folder.read(file), source = nameOfFile(path);
  const std::string_view kind = pictureKind(bytes);
  std::error_code ignored;
  const bool named = folder.isEmbedded() || fs::is_regular_file(path, ignored);
  const bool drawn = named ? !folder.isEmbedded() && path.extension() == ".png" : kind == "PNG";
  if (drawn) return parseDrawing(bytes, source, overrides);
  refusePicture(kind, source);
  return parseScene(bytes, source, overrides);
}

}  // namespace merge2d
