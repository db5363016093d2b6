/// Drawn scenes: those of a folder `drawings` beside the project, or where MERGE2D_DRAWINGS says.
/// Without such a folder there is nothing to test.

#include <cstdlib>
#include <filesystem>
#include <map>

#include "tests/scenes/scene_testing.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

constexpr int kSteps = 2000;

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

SceneRun ran(const fs::path& drawing, Mode mode) {
  SceneRun run(loadScene(drawing.string()), mode);
  run.steps(kSteps);
  return run;
}

TEST(Drawings, RunInAllModesWithoutBlowingUp) {
  for (const fs::path& drawing : allDrawings()) {
    for (const Mode mode : {Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
      const SceneRun run = ran(drawing, mode);
      const double fall = 9.81 * 0.01 * kSteps;  // [m/s]; some fall off the picture
      for (const BodyState& body : run.now().bodies) {
        EXPECT_TRUE(body.x.allFinite() && body.v.norm() < 1.05 * fall)
            << drawing.filename() << " in mode " << name(mode) << ": " << run.nameOf(body.id);
      }
      EXPECT_LT(run.now().stats.max_penetration, 0.1) << drawing.filename() << ' ' << name(mode);
    }
  }
}

/// Pairs with two loaded contacts are rigid by themselves: at rest they are to be one.
TEST(Drawings, MergeWhatRests) {
  for (const fs::path& drawing : allDrawings()) {
    const SceneRun sleeping = ran(drawing, Mode::Sleep), merged = ran(drawing, Mode::Merge);
    std::map<std::pair<BodyId, BodyId>, int> apart;
    for (const ContactView& contact : merged.now().contacts) {
      if (contact.internal || contact.lambda_n <= 0.0) continue;
      ++apart[{contact.a, contact.b}];
    }
    for (const auto& [pair, contacts] : apart) {
      const auto rests = [&](BodyId id) {
        return !sleeping.dynamic(id) || sleeping.body(sleeping.nameOf(id)).asleep;
      };
      if (contacts < 2 || !rests(pair.first) || !rests(pair.second)) continue;
      ADD_FAILURE() << drawing.filename() << ": " << merged.nameOf(pair.first) << " and "
                    << merged.nameOf(pair.second) << " rest on each other and are not merged";
    }
  }
}

}  // namespace
}  // namespace merge2d
