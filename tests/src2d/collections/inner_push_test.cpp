#include "src2d/collections/inner_push.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/src2d/relaxation/merged_testing.h"

namespace merge2d {
namespace {

std::vector<std::uint32_t> allMembers(const Collection& c) {
  std::vector<std::uint32_t> all(c.members.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

void expectSame(const std::vector<Twist>& one, const std::vector<Twist>& other) {
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t m = 0; m < one.size(); ++m) {
    EXPECT_EQ(one[m].vx, other[m].vx) << m;
    EXPECT_EQ(one[m].vy, other[m].vy) << m;
    EXPECT_EQ(one[m].omega, other[m].omega) << m;
  }
}

/// Contacts hold each brick against gravity.
TEST(InnerPush, HoldsTheWeightOfEachMember) {
  Merged merged(wall(8, 6));
  const State& state = merged.state();
  for (const Twist& push : merged.collection().push.of) {
    EXPECT_NEAR(push.vx, 0.0, 1e-4);
    EXPECT_NEAR(push.vy, -state.h * state.gravity.y(), 1e-4);
  }
}

/// To the last bit: bodies must not depend on which of the two was asked.
TEST(InnerPush, IsTheSameWhereItIsRenewedMemberByMember) {
  Merged merged(wall(8, 6));
  Collection& c = merged.collection();
  const std::vector<Twist> whole = c.push.of;
  renewPush(merged.state(), c, allMembers(c));
  expectSame(c.push.of, whole);
  EXPECT_EQ(c.push.unbalanced, allMembers(c));
}

TEST(InnerPush, IsLaidOutAnewOnceItIsForgotten) {
  Merged merged(wall(8, 6));
  Collection& c = merged.collection();
  const std::vector<Twist> before = c.push.of;
  const Impulses impulses = c.blocks.front().lambda;
  c.blocks.front().lambda_n(0) += 0.25;
  layOutPush(merged.state(), c);
  expectSame(c.push.of, before);
  c.push.forget();
  layOutPush(merged.state(), c);
  renewPush(merged.state(), c, allMembers(c));
  const std::vector<Twist> renewed = c.push.of;
  c.push.forget();
  layOutPush(merged.state(), c);
  expectSame(c.push.of, renewed);
  c.blocks.front().lambda = impulses;
  c.push.forget();
  layOutPush(merged.state(), c);
  expectSame(c.push.of, before);
}

}  // namespace
}  // namespace merge2d
