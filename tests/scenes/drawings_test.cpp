/// Drawn scenes: those of a folder `drawings` beside the project, or where MERGE2D_DRAWINGS says.
/// Without such a folder there is nothing to test.

#include <cstdlib>
#include <filesystem>

#include "tests/scenes/drawing_testing.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

fs::path drawings() {
  if (const char* chosen = std::getenv("MERGE2D_DRAWINGS")) return chosen;
  return fs::path(MERGE2D_SOURCE_DIR) / ".." / "shared" / "drawings";
}

std::vector<fs::path> allDrawings() {
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(drawings(), ignored)) {
    if (entry.path().extension() == ".png") found.push_back(entry.path());
  }
  std::ranges::sort(found);
  return found;
}

TEST(Drawings, RunInAllModesWithoutBlowingUp) {
  if (allDrawings().empty()) GTEST_SKIP() << "there is no drawing in " << drawings();
  for (const fs::path& drawing : allDrawings()) expectNoBlowUp(loadScene(drawing.string()));
}

TEST(Drawings, MergeWhatRests) {
  if (allDrawings().empty()) GTEST_SKIP() << "there is no drawing in " << drawings();
  for (const fs::path& drawing : allDrawings()) expectMergesWhatRests(loadScene(drawing.string()));
}

}  // namespace
}  // namespace merge2d
