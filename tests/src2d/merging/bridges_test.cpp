/// Welds that hold alone.

#include "src2d/merging/bridges.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/src2d/merging/merging_testing.h"

namespace merge2d {
namespace {

/// Which welds of the first collection are bridges, after each step.
class BridgeWatch : public Observer {
 public:
  void afterStage(Stage stage, const State& state, const Scratch&) override {
    if (stage != Stage::Merge || state.collections.empty()) return;
    bridges.clear();
    for (const Weld& weld : state.collections.front().welds) bridges.push_back(weld.bridge);
  }
  std::vector<bool> bridges;
};

std::vector<bool> bridgesOf(const std::string& scene) {
  Simulation run(scene, Mode::Merge);
  run.until(3.0);
  BridgeWatch watch;
  run.world().observe(&watch);
  run.steps(1);
  return watch.bridges;
}

TEST(Bridges, AreAllWeldsOfAColumn) {
  EXPECT_THAT(bridgesOf(kGround + R"(
[[body]]
name = "box"
at = [0, 0.5]
box = [1, 1]
repeat = { count = [1, 4], spacing = [1, 1] }
)"),
              testing::ElementsAre(true, true, true, true));
}

TEST(Bridges, AreNoneWhereTwoColumnsCarryABeam) {
  EXPECT_THAT(bridgesOf(kGround + R"(
[[body]]
name = "post"
at = [-1, 0.5]
box = [0.5, 1]
repeat = { count = [2, 1], spacing = [2, 1] }
[[body]]
name = "beam"
at = [0, 1.1]
box = [3, 0.2]
[[body]]
name = "crate"
at = [0, 1.35]
box = [0.3, 0.3]
)"),
              testing::UnorderedElementsAre(false, false, false, false, true))
      << "but for the crate on the beam";
}

}  // namespace
}  // namespace merge2d
