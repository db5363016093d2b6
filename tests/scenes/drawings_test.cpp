/// Drawn scenes: those of a folder `drawings` beside the project, or where MERGE2D_DRAWINGS says.
/// Without such a folder they have no tests but one, which says so.

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

TEST(DrawingsFolder, HasDrawings) {
  if (!allDrawings().empty()) return;
  ASSERT_EQ(std::getenv("MERGE2D_DRAWINGS"), nullptr) << "there are none in " << drawings();
  GTEST_SKIP() << "There is no folder of drawings beside the project, so none were run: name one "
                  "in MERGE2D_DRAWINGS, and build again.";
}

/// A test for each: without drawings there is none.
class Drawings : public testing::TestWithParam<fs::path> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Drawings);

TEST_P(Drawings, RunInAllModesWithoutBlowingUp) { expectNoBlowUp(loadScene(GetParam().string())); }

TEST_P(Drawings, MergeWhatRests) { expectMergesWhatRests(loadScene(GetParam().string())); }

INSTANTIATE_TEST_SUITE_P(All, Drawings, testing::ValuesIn(allDrawings()));

}  // namespace
}  // namespace merge2d
