/// Drawn scenes: those of a folder `drawings` beside the project, or where MERGE2D_DRAWINGS says.
/// Without such a folder there are no tests of them, which is said when the build is configured.

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/scenes/drawing_testing.h"
#include "tests/support/temporary_folder.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

fs::path drawings() {
  if (const char* chosen = std::getenv("MERGE2D_DRAWINGS")) return chosen;
  return fs::path(MERGE2D_SOURCE_DIR) / ".." / "shared" / "drawings";
}

std::vector<fs::path> drawingsIn(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".png") found.push_back(entry.path());
  }
  std::ranges::sort(found);
  return found;
}

TEST(DrawingsFolder, GivesItsPicturesInOrder) {
  const TemporaryFolder folder;
  for (const char* name : {"b.png", "notes.txt", "a.png"}) std::ofstream(folder.path() / name);
  const std::vector<fs::path> pictures{folder.path() / "a.png", folder.path() / "b.png"};
  EXPECT_EQ(drawingsIn(folder.path()), pictures);
  EXPECT_TRUE(drawingsIn(folder.path() / "elsewhere").empty());
}

/// A test for each: without drawings there is none.
class Drawings : public testing::TestWithParam<fs::path> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Drawings);

TEST_P(Drawings, RunInAllModesWithoutBlowingUp) { expectNoBlowUp(loadScene(GetParam().string())); }

TEST_P(Drawings, MergeWhatRests) { expectMergesWhatRests(loadScene(GetParam().string())); }

INSTANTIATE_TEST_SUITE_P(All, Drawings, testing::ValuesIn(drawingsIn(drawings())));

}  // namespace
}  // namespace merge2d
