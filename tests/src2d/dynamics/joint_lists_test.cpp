/// Which joints a body has.

#include "src2d/dynamics/joint_lists.h"

#include <gtest/gtest.h>

#include <vector>

namespace merge2d {
namespace {

std::vector<std::uint32_t> jointsOf(const JointsOfBodies& joints, std::uint32_t body) {
  std::vector<std::uint32_t> all;
  joints.forEach(BodyId{body}, [&](std::uint32_t joint) { all.push_back(joint); });
  return all;
}

using Joints = std::vector<std::uint32_t>;

TEST(JointsOfBodies, EachBodyHasThoseAtItTheNewestFirst) {
  JointsOfBodies joints;
  joints.add(0, BodyId{3}, BodyId{1});
  joints.add(1, BodyId{1}, std::nullopt);
  joints.add(2, BodyId{1}, BodyId{3});
  EXPECT_EQ(jointsOf(joints, 1), (Joints{2, 1, 0}));
  EXPECT_EQ(jointsOf(joints, 3), (Joints{2, 0}));
}

TEST(JointsOfBodies, ABodyWithoutAnyHasNone) {
  JointsOfBodies joints;
  EXPECT_TRUE(joints.empty());
  EXPECT_EQ(jointsOf(joints, 0), Joints{});
  joints.add(0, BodyId{2}, std::nullopt);
  EXPECT_EQ(jointsOf(joints, 1), Joints{});
  EXPECT_EQ(jointsOf(joints, 7), Joints{}) << "beyond the last body with a joint";
}

}  // namespace
}  // namespace merge2d
