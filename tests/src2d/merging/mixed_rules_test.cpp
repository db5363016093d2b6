/// Settings under which one rule merges and another unmerges.

#include "src2d/scene/rules.h"
#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

using testing::HasSubstr;

/// Two blocks on one floor, beside each other, and a plank across that a force lifts from 1 s on.
const std::string kBridge = kGround + R"(
[[body]]
name = "left"
at = [-1.5, 0.5]
box = [1, 1]
[[body]]
name = "right"
at = [1.5, 0.5]
box = [1, 1]
[[body]]
name = "plank"
at = [0, 1.1]
box = [4, 0.2]
[[force]]
body = "plank"
at = [0, 0]
force = [0, 20]
from = 1
)";

/// Two blocks on one floor, far from each other.
const std::string kTwoBlocks = kGround + R"(
[[body]]
name = "block"
at = [-5, 0.5]
box = [1, 1]
repeat = { count = [2, 1], spacing = [10, 1] }
)";

Overrides byRules(const std::string& merging, const std::string& unmerging) {
  return {{"merging.rule", merging}, {"unmerging.rule", unmerging}};
}

std::size_t collectionsAfter(const std::string& toml, double time, const Overrides& overrides) {
  Simulation run(toml, Mode::Merge, overrides);
  run.until(time);
  return run.now().collections.size();
}

TEST(MixedRules, TheRuleOfMergingDecidesWhetherAFloorMakesBlocksOne) {
  for (const std::string unmerging : {"default", "paper"}) {
    EXPECT_EQ(collectionsAfter(kTwoBlocks, 0.5, byRules("default", unmerging)), 2u) << unmerging;
    EXPECT_EQ(collectionsAfter(kTwoBlocks, 0.5, byRules("paper", unmerging)), 1u) << unmerging;
  }
}

/// The paper's rule of unmerging asks the rule of merging, the default one knows of no floors.
TEST(MixedRules, AFloorKeepsPartsTogetherWhereBothRulesAreThePapers) {
  const auto collections = [](const std::string& merging, const std::string& unmerging) {
    EXPECT_EQ(collectionsAfter(kBridge, 0.9, byRules(merging, unmerging)), 1u);
    return collectionsAfter(kBridge, 1.05, byRules(merging, unmerging));
  };
  EXPECT_EQ(collections("default", "default"), 2u);
  EXPECT_EQ(collections("default", "paper"), 2u);
  EXPECT_EQ(collections("paper", "default"), 2u);
  EXPECT_EQ(collections("paper", "paper"), 1u);
}

TEST(MixedRules, AreWarnedOfAndNoOthers) {
  const auto doubt = [](const std::string& merging, const std::string& unmerging) {
    const Scene scene = parseScene(kBridge, "test.toml", byRules(merging, unmerging));
    return doubtOfMixedRules(scene.settings).value_or("");
  };
  EXPECT_EQ(doubt("default", "default"), "");
  EXPECT_EQ(doubt("paper", "paper"), "");
  EXPECT_THAT(doubt("paper", "default"),
              HasSubstr("merging.rule is \"paper\" and unmerging.rule is \"default\""));
  EXPECT_THAT(doubt("default", "paper"),
              HasSubstr("merging.rule is \"default\" and unmerging.rule is \"paper\""));
}

}  // namespace
}  // namespace merge2d
