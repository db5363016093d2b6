#include "src2d/core/regrouping.h"

#include <gtest/gtest.h>

namespace merge2d {
namespace {

constexpr std::uint32_t kNew = Regrouping::kNew;

/// Those at new places are shown as 0.
std::vector<int> regrouped(std::vector<int> v, const std::vector<std::uint32_t>& from) {
  Regrouping(from).apply(v);
  EXPECT_EQ(v.size(), from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (from[i] == kNew) v[i] = 0;
  }
  return v;
}

TEST(Regrouping, LeavesAVectorAloneInWhichNothingChanges) {
  EXPECT_EQ(regrouped({1, 2, 3}, {0, 1, 2}), (std::vector<int>{1, 2, 3}));
}

TEST(Regrouping, MakesRoomForNewOnes) {
  EXPECT_EQ(regrouped({1, 2, 3}, {kNew, 0, kNew, kNew, 1, 2, kNew}),
            (std::vector<int>{0, 1, 0, 0, 2, 3, 0}));
}

TEST(Regrouping, ClosesTheGapsOfThoseThatLeave) {
  EXPECT_EQ(regrouped({1, 2, 3, 4, 5, 6}, {1, 2, 5}), (std::vector<int>{2, 3, 6}));
}

TEST(Regrouping, SomeMoveToTheFrontAndOthersToTheEnd) {
  EXPECT_EQ(regrouped({1, 2, 3, 4, 5, 6}, {2, kNew, kNew, kNew, 3, kNew, 4}),
            (std::vector<int>{3, 0, 0, 0, 4, 0, 5}));
  EXPECT_EQ(regrouped({1, 2, 3, 4, 5, 6}, {kNew, kNew, 0, 4, 5}),
            (std::vector<int>{0, 0, 1, 5, 6}));
}

TEST(Regrouping, PutsThemInAnotherOrder) {
  EXPECT_EQ(regrouped({1, 2, 3, 4}, {3, kNew, 0, 2}), (std::vector<int>{4, 0, 1, 3}));
}

TEST(Regrouping, AnEmptyVectorGetsNewOnesAlone) {
  EXPECT_EQ(regrouped({}, {kNew, kNew}), (std::vector<int>{0, 0}));
  EXPECT_EQ(regrouped({1, 2}, {}), std::vector<int>());
}

}  // namespace
}  // namespace merge2d
