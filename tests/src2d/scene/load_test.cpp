#include "src2d/scene/load.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src2d/core/error.h"

namespace merge2d {
namespace {

TEST(Load, AnEmptySceneHasTheDefaultsOfTheContract) {
  const Scene scene = parseScene("format = 1\n", "empty.toml");
  EXPECT_EQ(scene.name, "empty");
  EXPECT_DOUBLE_EQ(scene.gravity.y(), -9.81);
  EXPECT_DOUBLE_EQ(scene.step, 0.01);
}

}  // namespace
}  // namespace merge2d
