#include "src2d/core/index_runs.h"

#include <gtest/gtest.h>

#include <utility>

namespace merge2d {
namespace {

std::vector<std::uint32_t> listOf(const IndexRuns& runs, std::size_t thing) {
  return {runs[thing].begin(), runs[thing].end()};
}

IndexRuns built(std::size_t things, const std::vector<std::pair<std::size_t, unsigned>>& entries) {
  IndexRuns runs;
  runs.build(things, [&](auto&& visit) {
    for (const auto& [thing, index] : entries) visit(thing, index);
  });
  return runs;
}

TEST(IndexRuns, KeepsTheOrderOfEachList) {
  const IndexRuns runs = built(3, {{2, 7}, {0, 5}, {2, 1}, {0, 9}, {2, 4}});
  EXPECT_EQ(listOf(runs, 0), (std::vector<std::uint32_t>{5, 9}));
  EXPECT_EQ(listOf(runs, 1), std::vector<std::uint32_t>());
  EXPECT_EQ(listOf(runs, 2), (std::vector<std::uint32_t>{7, 1, 4}));
}

TEST(IndexRuns, OfNothingHasNoLists) {
  EXPECT_TRUE(IndexRuns().empty());
  EXPECT_FALSE(built(0, {}).empty());
}

}  // namespace
}  // namespace merge2d
