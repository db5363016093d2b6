#pragma once
/// Whole files, with a limit on their size.

#include <filesystem>
#include <string>

namespace merge2d {

/// The bytes of a file. Throws InputError when there are more than `SceneLimits::kFileBytes`,
/// IoError when they cannot be read.
std::string readFile(const std::filesystem::path& path);

}  // namespace merge2d
