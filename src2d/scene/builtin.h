#pragma once
/// Where the built-in scenes are.

#include <filesystem>
#include <optional>
#include <string>

namespace merge2d {

/// The file of a built-in scene, if there is one of this name.
std::optional<std::filesystem::path> builtinScene(const std::string& name);

}  // namespace merge2d
