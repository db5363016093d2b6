#include "src2d/scene/file.h"

#include <fmt/format.h>

#include <fstream>
#include <system_error>

#include "src2d/core/error.h"
#include "src2d/scene/scene.h"

namespace merge2d {

std::string readFile(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) throw IoError(fmt::format("{}: {}", name, error.message()));
  if (size > SceneLimits::kFileBytes) {
    throw InputError(fmt::format("{}: a scene file has at most {} MB, this one has {} MB", name,
                                 SceneLimits::kFileBytes >> 20u, size >> 20u));
  }
  std::string bytes(size, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!in) throw IoError(fmt::format("{}: cannot be read", name));
  return bytes;
}

}  // namespace merge2d
