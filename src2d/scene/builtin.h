#pragma once
/// The scenes that come with the program.

#include <optional>
#include <string>

#include "src2d/scene/data_folder.h"

namespace merge2d {

/// A file, and the folder that holds it.
struct DataFile {
  DataFolder folder;
  std::string name;
};

/// The file of a built-in scene, if there is one of this name.
std::optional<DataFile> builtinScene(const std::string& name);

/// The files of `scenes/` as they were when the program was built.
std::span<const EmbeddedFile> embeddedScenes();

}  // namespace merge2d
