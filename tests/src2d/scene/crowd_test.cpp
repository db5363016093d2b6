#include "src2d/scene/crowd.h"

#include <chrono>

#include "tests/src2d/scene/scene_testing.h"

namespace merge2d {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string repeated(std::string_view shape, int columns, int rows, std::string_view spacing) {
  return fmt::format(
      "[[body]]\nname = \"brick\"\n{}\nrepeat = {{ count = [{}, {}], spacing = {} }}\n", shape,
      columns, rows, spacing);
}

/// Bodies of the same kind, each written by itself.
std::string written(int n, std::string_view more) {
  std::string text;
  for (int i = 0; i < n; ++i) text += fmt::format("[[body]]\nbox = [1, 1]\n{}\n", more);
  return text;
}

TEST(Crowd, CopiesInOnePlaceAreRefusedByName) {
  EXPECT_EQ(firstLineOf(repeated("box = [1, 1]", 3000, 1, "[0, 0]")),
            "s.toml:4:10: 2,999 bodies lie in the place of brick[0,0], but at most 100 may; is "
            "'spacing' right?");
}

TEST(Crowd, EveryKindOfCopiesIsFound) {
  for (const std::string& scene :
       {repeated("circle = 0.5", 60, 50, "[0, 0]"), repeated("box = [20, 0.1]", 2000, 1, "[0, 0]"),
        repeated("polygon = [[0, 0], [1, 0], [0, 1]]", 1, 500, "[0, 0]"),
        repeated("box = [1, 1]", 3000, 1, "[0.001, 0]"),
        repeated("box = [100, 0.1]\nangle = 37", 2000, 1, "[0.0005, 0]"),
        repeated("shapes = [{ box = [1, 0.1], at = [0, 1] }, { box = [1, 0.1], at = [0, -1] }]",
                 200, 1, "[0, 0]")}) {
    EXPECT_THAT(firstLineOf(scene), HasSubstr("lie in the place of brick[")) << scene;
  }
}

TEST(Crowd, BodiesWrittenOneByOneAreRefusedByTheFirst) {
  EXPECT_THAT(
      firstLineOf(written(150, "at = [3, 4]")),
      HasSubstr("149 bodies lie in the place of body1, but at most 100 may; is 'at' right?"));
}

TEST(Crowd, HowManyMayShareAPlaceIsStated) {
  EXPECT_EQ(errorOf(written(101, "")), "no error");
  EXPECT_THAT(errorOf(written(102, "")), HasSubstr("101 bodies lie in the place of body1"));
}

TEST(Crowd, WhatComesOutOfAnEmitterAtOnceIsCounted) {
  const auto emitter = [](std::string_view more) {
    return fmt::format("[[emitter]]\nname = \"drop\"\ncircle = 0.1\ncount = 3000\n{}\n", more);
  };
  EXPECT_EQ(firstLineOf(emitter("every = 1e-6")),
            "s.toml:5:9: 2,999 bodies come into the place of drop[0] within one step, but at most "
            "100 may: are 'every' and 'spread' right?");
  EXPECT_EQ(errorOf(emitter("every = 1e-6\nspread = [20, 20]")), "no error");
  EXPECT_EQ(errorOf(emitter("every = 0.01")), "no error");
}

TEST(Crowd, WhatDoesNotCollideIsNoCrowd) {
  EXPECT_EQ(errorOf(repeated("box = [1, 1]\nmotion = \"pinned\"", 3000, 1, "[0, 0]")), "no error");
  // A basin holds all of them, but no two are in one place.
  EXPECT_EQ(errorOf("[[body]]\nname = \"tub\"\nbox = [200, 200]\nat = [50, 50]\n" +
                    repeated("box = [1, 1]", 70, 70, "[1, 1]")),
            "no error");
}

TEST(Crowd, JoinedBodiesMayOverlapInGreatNumbers) {
  std::string star = "[[body]]\nname = \"hub\"\ncircle = 0.5\n";
  star += repeated("box = [4, 0.1]", 500, 1, "[0, 0]");
  for (int i = 0; i < 500; ++i) {
    star += fmt::format(
        "[[joint]]\nkind = \"weld\"\nat = [0, 0]\nbodies = [\"hub\", \"brick[{},0]\"]\n", i);
  }
  EXPECT_EQ(errorOf(star), "no error");
}

/// Towers and walls of the largest size that a scene may have, without a pair in one place.
TEST(Crowd, LargeScenesThatTouchAreNone) {
  EXPECT_EQ(errorOf(repeated("box = [1, 1]", 1000, 100, "[1, 1]")), "no error");
  EXPECT_EQ(errorOf(repeated("box = [1, 0.001]", 1, 10000, "[1, 0.001]")), "no error");
  EXPECT_EQ(errorOf(repeated("box = [100, 0.1]\nangle = 45", 1, 5000, "[0, 0.15]")), "no error");
}

}  // namespace
}  // namespace merge2d
