/// docs/records.md lists every decision record that a run can make.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "src2d/scene/load.h"
#include "src2d/world.h"
#include "tests/docs/docs_testing.h"

namespace merge2d::docs {
namespace {

TEST(Records, ThePageListsEveryRecordThatScenesMake) {
  using Record = std::tuple<std::string, std::string, std::string>;  // stage, criterion, verdict
  std::set<Record> listed;
  for (const auto& row : tableRows(pageOf(read(kRoot / "docs/records.md")).prose)) {
    for (const std::string& verdict : codeIn(row[4])) {
      for (const std::string& criterion : codeIn(row[1])) {
        listed.emplace(row[0], criterion, verdict);
      }
    }
  }
  ASSERT_GT(listed.size(), 20u);
  std::set<std::string_view> criteria;
  for (const auto& [scene, steps] : {std::pair{"dominoes", 250}, std::pair{"books", 200}}) {
    World world(loadScene(scene), {.timings = false, .decisions = true});
    for (int i = 0; i < steps; ++i) {
      world.step();
      for (const Decision& d : world.notes().decisions) {
        criteria.insert(d.criterion);
        if (d.verdict == "cut") continue;  // told in the text
        const Record record(d.stage, d.criterion, d.verdict);
        EXPECT_TRUE(listed.contains(record)) << d.stage << " " << d.criterion << " " << d.verdict;
      }
    }
  }
  EXPECT_GE(criteria.size(), 8u);
}

/// "margin" on the page: but for groups and pivots the value and the threshold alone tell whether a
/// criterion holds.
TEST(Records, ValueAndThresholdTellWhetherACriterionHolds) {
  const std::set<std::string_view> holds{"below", "carried", "keep", "sleep", "merge", "touch"};
  const std::set<std::string_view> asks_for_enough{"hit", "pressed", "steady", "count"};
  const std::set<std::string_view> asks_for_more{"cycle", "freedoms"};
  std::set<std::string_view> criteria;
  for (const char* scene : {"dominoes", "books", "wagon", "seesaw", "slope", "tower-impulse"}) {
    World world(loadScene(scene), {.timings = false, .decisions = true});
    for (int i = 0; i < 400; ++i) {
      world.step();
      for (const Decision& d : world.notes().decisions) {
        if (asks_for_more.contains(d.criterion)) continue;
        criteria.insert(d.criterion);
        const bool enough = asks_for_enough.contains(d.criterion) ||
                            (d.stage == "SleepAndWake" && d.criterion == "rest");
        const double margin = (enough ? -1.0 : 1.0) * (d.threshold - d.value);
        EXPECT_TRUE(holds.contains(d.verdict) ? margin >= 0.0 : margin <= 1e-9)
            << scene << ": " << d.stage << " " << d.criterion << " " << d.value << " against "
            << d.threshold << ": " << d.verdict;
        if (d.criterion == "edge") {
          EXPECT_EQ(holds.contains(d.verdict), margin > 0.0) << d.value;
        }
      }
    }
  }
  EXPECT_GE(criteria.size(), 17u);
}

/// Eq. (17) is about merging; its measure at unmerging is that of Section 6.4.
TEST(Records, ThePapersTestsCiteTheSectionThatMakesThem) {
  Scene scene = loadScene("unmerge-pivot");
  scene.settings.merging.rule = MergingRule::Paper;
  scene.settings.unmerging.rule = UnmergingRule::Paper;
  World world(scene, {.mode = Mode::Merge, .timings = false, .decisions = true});
  int asked = 0;
  for (int i = 0; i < 400; ++i) {
    world.step();
    for (const Decision& d : world.notes().decisions) {
      if (d.stage != "Unmerge" || d.criterion != "relative-motion") continue;
      EXPECT_EQ(d.equation, "Section 6.4");
      ++asked;
    }
  }
  EXPECT_GT(asked, 0);
}

}  // namespace
}  // namespace merge2d::docs
