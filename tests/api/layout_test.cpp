/// Programs that were built with an earlier header of the same soname have these layouts.

#include <gtest/gtest.h>
#include <merge2d/merge2d.h>

#include <cstddef>

namespace {

/// On 64-bit machines. Where one changes after a release, the soname must.
TEST(PublicLayout, IsThatOfTheSoname) {
  EXPECT_EQ(sizeof(m2_vec), 16U);
  EXPECT_EQ(sizeof(m2_shape), 72U);
  EXPECT_EQ(sizeof(m2_key), 32U);
  EXPECT_EQ(sizeof(m2_script), 80U);
  EXPECT_EQ(sizeof(m2_body_def), 216U);
  EXPECT_EQ(sizeof(m2_spring_def), 72U);
  EXPECT_EQ(sizeof(m2_joint_def), 168U);
  EXPECT_EQ(sizeof(m2_body_info), 40U);
  EXPECT_EQ(sizeof(m2_piece), 160U);
  EXPECT_EQ(sizeof(m2_contact), 88U);
  EXPECT_EQ(sizeof(m2_joint_state), 72U);
  EXPECT_EQ(sizeof(m2_collection), 80U);
  EXPECT_EQ(sizeof(m2_event), 20U);
  EXPECT_EQ(sizeof(m2_decision), 160U);
  EXPECT_EQ(sizeof(m2_counts), 24U);
  EXPECT_EQ(sizeof(m2_sums), 56U);
  EXPECT_EQ(sizeof(m2_ray_hit), 48U);
  EXPECT_EQ(sizeof(m2_picture_def), 56U);
  EXPECT_EQ(offsetof(m2_body_def, script), 136U);
  EXPECT_EQ(offsetof(m2_joint_def, collide), 160U);
  EXPECT_EQ(offsetof(m2_contact, x), 16U);
  EXPECT_EQ(offsetof(m2_decision, stage), 40U);
}

}  // namespace
