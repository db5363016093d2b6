/// Records of collections that are opened for another reason than their own load.

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

/// The records of one criterion under WarmStart in the last step.
std::vector<Decision> recordsOf(const Simulation& run, std::string_view criterion) {
  std::vector<Decision> found;
  for (const Decision& d : run.world().notes().decisions) {
    if (d.criterion == criterion && d.stage == "WarmStart") found.push_back(d);
  }
  return found;
}

/// A flag that is set.
void expectOpened(const Decision& d, BodyId first) {
  EXPECT_EQ(d.a, first);
  EXPECT_EQ(d.b, first);
  EXPECT_EQ(d.value, 1.0);
  EXPECT_EQ(d.threshold, 0.0);
  EXPECT_EQ(d.verdict, "open");
  EXPECT_EQ(d.equation, kOwnDecided);
  EXPECT_EQ(d.needed, 0);
}

/// Three columns of two boxes; a ball falls on the first from 1 s on, the second stands 2 mm beside
/// it, the third far away.
const std::string kThreeColumns = kGround + R"(
[[body]]
name = "struck"
at = [0, 0.5]
box = [1, 1]
repeat = { count = [1, 2], spacing = [1, 1] }
[[body]]
name = "beside"
at = [1.002, 0.5]
box = [1, 1]
repeat = { count = [1, 2], spacing = [1, 1] }
[[body]]
name = "far"
at = [4, 0.5]
box = [1, 1]
repeat = { count = [1, 2], spacing = [1, 1] }
[[body]]
name = "ball"
at = [0, 3]
circle = 0.2
pinned_until = 1
)";

TEST(LoadRecords, ANeighbourOfWhatWasHitIsOpenForAsLong) {
  Simulation run(kThreeColumns, Mode::Merge, {}, true);
  int opened = 0;
  run.steps(150, [&] {
    const auto hit = recordsOf(run, "hit"), neighbour = recordsOf(run, "neighbour-hit");
    ASSERT_LE(hit.size(), 1u);
    ASSERT_EQ(neighbour.size(), hit.size());
    if (hit.empty()) return;
    ++opened;
    EXPECT_EQ(hit[0].a, run.id("struck[0,0]"));
    EXPECT_LT(hit[0].value, hit[0].threshold);
    EXPECT_EQ(hit[0].verdict, "open");
    expectOpened(neighbour[0], run.id("beside[0,0]"));
  });
  EXPECT_GE(opened, 3) << "merging.steps";
  EXPECT_LT(opened, 10);
}

/// A plank with a block lies on the ground, and on a platform that creeps away from 2 s on.
const std::string kCreep = R"(
format = 1
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [8, 1]
[[body]]
name = "platform"
motion = "scripted"
box = [4, 1]
script = { keyframes = [[0, 6, -0.5, 0], [2, 6, -0.5, 0], [4, 6.02, -0.5, 0]] }
[[body]]
name = "plank"
at = [3, 0.1]
box = [8, 0.2]
[[body]]
name = "block"
at = [0, 0.4]
box = [1, 0.4]
)";

TEST(LoadRecords, ACollectionThatAFrameDragsIsOpenWhileTheFrameMoves) {
  Simulation run(kCreep, Mode::Merge, {}, true);
  run.steps(200, [&] { EXPECT_TRUE(recordsOf(run, "dragged").empty()); });
  ASSERT_TRUE(run.anchored("plank"));
  run.steps(100, [&] {
    const auto dragged = recordsOf(run, "dragged");
    ASSERT_EQ(dragged.size(), 1u);
    expectOpened(dragged[0], run.id("plank"));
  });
}

}  // namespace
}  // namespace merge2d
