/// Pictures of a world.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <merge2d/merge2d.h>

#include "api_testing.h"

namespace {

using merge2d::World;
using merge2d::testing_api::refusal;
using merge2d::testing_api::towerOf;
using ::testing::HasSubstr;

TEST(PublicPictures, DrawTheWorld) {
  World world(towerOf(3));
  auto def = merge2d::pictureDef();
  def.width = 160;
  def.height = 120;
  def.overlays = "none";
  const auto first = world.draw(def);
  ASSERT_EQ(first.size(), 4U * 160 * 120);
  world.setPose(3, {2.0, 2.5}, 0.3);
  EXPECT_NE(world.draw(def), first);
  def.theme = "drak";
  EXPECT_THAT(refusal([&] { world.draw(def); }), HasSubstr("did you mean 'dark'"));
  for (const int width : {-1, 0, 100'000}) {
    def.width = width;
    EXPECT_THAT(refusal([&] { world.draw(def); }), HasSubstr("16 to 16384 pixels"));
  }
}

}  // namespace
