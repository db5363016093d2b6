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

}  // namespace
}  // namespace merge2d::docs
