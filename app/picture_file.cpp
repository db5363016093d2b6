#include "app/picture_file.h"

#include <fmt/format.h>

#include <fstream>
#include <string>
#include <system_error>

#include "app/usage_error.h"
#include "render/new_file.h"
#include "render/png.h"
#include "render/svg.h"
#include "src2d/core/error.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const std::string& why) {
  throw IoError(fmt::format("cannot write {}: {}", file.string(), why));
}

bool isOurSvg(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string start(kSvgStart.size(), '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  return in && start == kSvgStart;
}

}  // namespace

void requirePictureMayAppear(const fs::path& file, bool force) {
  std::error_code ignored;
  const fs::file_status status = fs::status(file, ignored);
  if (fs::is_directory(status)) fail(file, "it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) fail(file, "it is no ordinary file");
  if (fs::exists(status) && !force && fs::file_size(file, ignored) > 0 && !isOurPng(file) &&
      !isOurSvg(file)) {
    throw UsageError(
        fmt::format("{} is there already and is no picture of merge2d; say --force to replace it",
                    file.string()));
  }
  const NewFile probe(file);  // rights do not tell of every file system
}

}  // namespace merge2d
