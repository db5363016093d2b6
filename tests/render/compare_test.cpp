#include "render/compare.h"

#include <gtest/gtest.h>

#include "render/png.h"
#include "tests/render/temporary_folder.h"

namespace merge2d {
namespace {

TEST(CompareImages, SmallDifferencesAreTolerated) {
  const Image a(10, 10, rgb(0x808080));
  EXPECT_EQ(compareImages(a, Image(10, 10, rgb(0x82827e))).fraction, 0.0);
  EXPECT_EQ(compareImages(a, Image(10, 10, rgb(0x838080))).fraction, 1.0);
  EXPECT_EQ(compareImages(a, Image(10, 10, rgb(0x838080))).largest, 3);
}

TEST(CompareImages, OtherSizesDiffer) {
  EXPECT_FALSE(compareImages(Image(10, 10), Image(10, 11)).same_size);
}

TEST(CompareWithReference, LeavesAPictureOfWhatDiffers) {
  const TemporaryFolder folder;
  Image image(20, 10, rgb(0xffffff));
  savePng(folder.path() / "a.png", image);
  EXPECT_EQ(compareWithReference(image, folder.path() / "a.png", folder.path() / "out"), "");
  image.rgba[image.offset(4, 3)] = 0;
  const std::string answer =
      compareWithReference(image, folder.path() / "a.png", folder.path() / "out");
  EXPECT_NE(answer.find("0.50% of the pixels differ"), std::string::npos) << answer;
  EXPECT_EQ(loadPng(folder.path() / "out" / "a.difference.png").at(4, 3), rgb(0xd00000));
}

TEST(CompareWithReference, SaysWhenTheReferenceIsMissing) {
  const TemporaryFolder folder;
  const std::string answer =
      compareWithReference(Image(4, 4), folder.path() / "none.png", folder.path() / "out");
  EXPECT_NE(answer.find("is missing"), std::string::npos);
}

}  // namespace
}  // namespace merge2d
