#include "render/ticks.h"

#include <gtest/gtest.h>

namespace merge2d {
namespace {

TEST(Ticks, AreRoundNumbersInTheRange) {
  EXPECT_EQ(ticks(0.0, 10.0, 5), (std::vector<double>{0.0, 2.0, 4.0, 6.0, 8.0, 10.0}));
  const std::vector<double> small = ticks(0.0, 0.043, 4);
  EXPECT_GE(small.size(), 3U);
  EXPECT_LE(small.back(), 0.043);
  EXPECT_EQ(ticks(-1.0, 1.0, 2).front(), -1.0);
}

}  // namespace
}  // namespace merge2d
