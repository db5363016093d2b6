#include <gmock/gmock.h>

#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

class List : public ProgramTest {};

TEST_F(List, NamesEachSceneInALineWithItsTitle) {
  const Outcome outcome = run({"list"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, ContainsRegex("\n  tower-platform +A tower on a swinging platform"));
  EXPECT_THAT(outcome.err, IsEmpty());
}

TEST_F(List, GivesScenesAndLessonsAsJson) {
  const Json list = run({"list", "--json"}).json();
  EXPECT_THAT(keysOf(list), ElementsAre("scenes", "lessons"));
  ASSERT_FALSE(list["scenes"].empty());
  for (const Json& scene : list["scenes"]) EXPECT_THAT(keysOf(scene), ElementsAre("name", "title"));
}

TEST_F(List, NamesScenesThatRun) {
  for (const Json& scene : run({"list", "--json"}).json()["scenes"]) {
    EXPECT_EQ(run({"run", scene["name"], "--steps", "2"}).code, 0) << scene["name"];
  }
}

}  // namespace
}  // namespace merge2d
