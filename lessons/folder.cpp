#include "lessons/folder.h"

#include <cstdlib>

namespace merge2d {

namespace fs = std::filesystem;

fs::path lessonFolder() {
  if (const char* chosen = std::getenv("MERGE2D_LESSONS")) return chosen;
  std::error_code ignored;
  const fs::path source = MERGE2D_LESSONS_SOURCE_DIR;
  return fs::is_directory(source, ignored) ? source : fs::path(MERGE2D_LESSONS_INSTALL_DIR);
}

}  // namespace merge2d
