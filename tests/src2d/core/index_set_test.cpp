#include "src2d/core/index_set.h"

#include <gtest/gtest.h>

namespace merge2d {
namespace {

TEST(IndexSet, ListsEachIndexOnceAscending) {
  IndexSet set(130);
  for (const std::uint32_t index : {129u, 0u, 64u, 63u, 64u, 0u}) set.add(index);
  EXPECT_EQ(set.ascending(), (std::vector<std::uint32_t>{0, 63, 64, 129}));
}

TEST(IndexSet, IsEmptyAtFirst) { EXPECT_TRUE(IndexSet(64).ascending().empty()); }

}  // namespace
}  // namespace merge2d
