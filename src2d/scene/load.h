#pragma once
/// From names and files to scenes.

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "src2d/scene/data_folder.h"
#include "src2d/scene/scene.h"

namespace merge2d {

/// `--set key=value`, in the order given; the value as TOML, or a bare word as a string.
using Overrides = std::vector<std::pair<std::string, std::string>>;

/// A built-in name, a `.toml` scene, a drawn `.png` scene, or a pipe or `-` (the standard input)
/// with either of them. Throws InputError with the place, the expected value and a suggestion;
/// IoError when it cannot be read.
Scene loadScene(const std::string& name_or_path, const Overrides& overrides = {});

/// A scene of a folder that may be built into the program.
Scene loadSceneFile(const DataFolder& folder, const std::string& file,
                    const Overrides& overrides = {});

/// A text scene; `source` stands for the file's name in messages.
Scene parseScene(std::string_view toml, const std::string& source, const Overrides& overrides = {});

/// A drawn scene (pixel art).
Scene loadDrawing(const std::filesystem::path& png, const Overrides& overrides = {});

/// The same from the bytes of a PNG picture; `source` stands for the file's name in messages.
Scene parseDrawing(const std::string& png, const std::string& source,
                   const Overrides& overrides = {});

/// The scene as a text scene that loads to the same scene again.
std::string toToml(const Scene& scene);

struct BuiltinScene {
  std::string name;
  std::string title;
};
/// The scenes that come with the program and those in the data folders, by name.
std::vector<BuiltinScene> builtinScenes();

}  // namespace merge2d
