#include "render/stage_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/contact_sheet.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

/// A column of boxes that is hit at its top, in the step of the blow.
class StageFrame : public testing::Test {
 protected:
  StageFrame() : recorder(hitColumn()) {
    style.width = 640;
    style.height = 360;
    const World& world = recorder.world();
    adaptToScene(style, world.scene(), world.capture(), world.bodies());
    recorder.skipTo(200);
    record = recorder.record();
  }

  static Scene hitColumn() {
    Scene scene = column(4);
    scene.impulses.push_back({.body = 4, .at = {0.0, 4.0}, .impulse = {4.0, 0.0}, .time = 2.0});
    return scene;
  }

  Picture draw(Stage stage, const Snapshot* reference = nullptr) {
    StageDrawer drawer(recorder.world().bodies(), style);
    return drawer.draw(record, stage, {"Why?", "because"}, reference);
  }

  /// Pixels of the world, without caption and footer, that differ.
  static int differences(const Picture& a, const Picture& b) {
    int count = 0;
    for (int y = 70; y < a.height - 50; ++y) {
      for (int x = 0; x < a.width; ++x) count += a.at(x, y) != b.at(x, y);
    }
    return count;
  }

  FrameStyle style;
  Recorder recorder;
  StepRecord record;
};

TEST_F(StageFrame, EachStageHasAPictureOfItsOwn) {
  std::vector<Picture> pictures;
  for (std::size_t i = 0; i < kStages; ++i) pictures.push_back(draw(static_cast<Stage>(i)));
  for (std::size_t i = 0; i < kStages; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      // Without something to sleep or to merge these two show the bodies alone.
      EXPECT_GT(differences(pictures[i], pictures[k]), 0)
          << name(static_cast<Stage>(i)) << " and " << name(static_cast<Stage>(k));
    }
  }
}

TEST_F(StageFrame, TheSameStageGivesTheSamePixels) {
  EXPECT_EQ(draw(Stage::Unmerge).rgba, draw(Stage::Unmerge).rgba);
}

TEST_F(StageFrame, TheReferencesVelocitiesAreShownWhereThereAreSome) {
  Snapshot reference = record.after;
  for (BodyState& body : reference.bodies) body.v = {2.0, 0.0};
  EXPECT_GT(differences(draw(Stage::AdvanceVelocities), draw(Stage::AdvanceVelocities, &reference)),
            50);
}

TEST_F(StageFrame, TheLegendOfUnmergeExplainsWeldsThatAreNotTested) {
  const auto legend = [](const Picture& p) {
    const auto rows = static_cast<std::ptrdiff_t>(p.height - 30) * p.width * 4;
    return std::vector<std::uint8_t>(p.rgba.begin() + rows, p.rgba.end());
  };
  const auto stage = static_cast<std::size_t>(Stage::Unmerge);
  Snapshot &before = record.stages[stage - 1].after, &after = record.stages[stage].after;
  ASSERT_FALSE(before.welds.empty());
  const auto tested = legend(draw(Stage::Unmerge));
  after.decisions.clear();  // as for what sleeps
  after.events.clear();
  EXPECT_NE(tested, legend(draw(Stage::Unmerge)));
  before.welds.clear();
  EXPECT_EQ(tested, legend(draw(Stage::Unmerge)));
}

TEST_F(StageFrame, IsDescribedInWords) {
  EXPECT_THAT(describeStage(record, Stage::Unmerge, {"Why?", "because"}, style),
              testing::EndsWith("Step 201, stage 6 of 11, Unmerge: Why? Because."));
}

TEST(ContactSheet, PutsPicturesIntoRows) {
  const std::vector<Picture> pictures(5, Picture(10, 6, rgb(0x112233)));
  const Picture sheet = contactSheet(pictures, 3, rgb(0xffffff));
  EXPECT_EQ(sheet.width, 3 * 10 + 2 * 8);
  EXPECT_EQ(sheet.height, 2 * 6 + 8);
  EXPECT_EQ(sheet.at(0, 0), rgb(0x112233));
  EXPECT_EQ(sheet.at(12, 0), rgb(0xffffff));  // between two
  EXPECT_EQ(sheet.at(18, 14), rgb(0x112233));
  EXPECT_EQ(sheet.at(40, 14), rgb(0xffffff));  // there is no sixth
}

TEST(ContactSheet, ShrinksByMeansThatKeepTheBrightness) {
  Picture checkered(8, 8);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      const std::uint8_t v = (x + y) % 2 == 0 ? 0 : 200;
      std::uint8_t* p = checkered.rgba.data() + checkered.offset(x, y);
      p[0] = p[1] = p[2] = v, p[3] = 255;
    }
  }
  const Picture small = shrunk(checkered, 4);
  EXPECT_EQ(small.width, 4);
  EXPECT_EQ(small.at(1, 1), (Color{100, 100, 100, 255}));
  EXPECT_EQ(shrunk(checkered, 8).rgba, checkered.rgba);
}

}  // namespace
}  // namespace merge2d
