#pragma once
/// Whole files, pipes and devices, with a limit on their size.

#include <filesystem>
#include <string>
#include <string_view>

#include "src2d/scene/scene.h"

namespace merge2d {

/// The expected kind of a file.
struct FileKind {
  std::string_view what = "a scene file";      ///< in messages
  std::size_t most = SceneLimits::kFileBytes;  ///< bytes
  std::string_view start = {};                 ///< another file is not read to its end
};

/// `-` names the standard input.
bool isStandardInput(const std::filesystem::path& path);
/// How messages call the standard input.
inline constexpr std::string_view kStandardInput = "<stdin>";
/// As messages name it.
std::string nameOfFile(const std::filesystem::path& path);

/// The bytes of a file, or of all that a pipe brings. Throws InputError when there are more than
/// `kind.most`, IoError when they cannot be read, with the reason.
std::string readFile(const std::filesystem::path& path, const FileKind& kind = {});

}  // namespace merge2d
