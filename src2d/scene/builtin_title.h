#pragma once
/// Titles of scenes and lessons: those of embedded files are known from the build, and need no
/// parser.

#include <optional>
#include <span>
#include <string>

#include "src2d/scene/data_folder.h"

namespace merge2d {

/// The title in a TOML file of a folder, as it is written there; nothing where the file has none.
/// A file that equals one of `embedded` is not parsed. Throws an InputError where another one is no
/// TOML; as `DataFolder::read`.
std::optional<std::string> titleOf(const DataFolder& folder, const std::string& file,
                                   std::span<const EmbeddedFile> embedded);

}  // namespace merge2d
