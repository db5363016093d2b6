#include "render/compare.h"

#include <gtest/gtest.h>

#include "render/png.h"
#include "tests/support/temporary_folder.h"

namespace merge2d {
namespace {

TEST(ComparePictures, SmallDifferencesAreTolerated) {
  const Picture a(10, 10, rgb(0x808080));
  EXPECT_EQ(comparePictures(a, Picture(10, 10, rgb(0x82827e))).fraction, 0.0);
  EXPECT_EQ(comparePictures(a, Picture(10, 10, rgb(0x838080))).fraction, 1.0);
  EXPECT_EQ(comparePictures(a, Picture(10, 10, rgb(0x838080))).largest, 3);
}

TEST(ComparePictures, OtherSizesDiffer) {
  EXPECT_FALSE(comparePictures(Picture(10, 10), Picture(10, 11)).same_size);
}

TEST(CompareWithReference, LeavesAPictureOfWhatDiffers) {
  const TemporaryFolder folder;
  Picture picture(20, 10, rgb(0xffffff));
  savePng(folder.path() / "a.png", picture);
  EXPECT_EQ(compareWithReference(picture, folder.path() / "a.png", folder.path() / "out"), "");
  picture.rgba[picture.offset(4, 3)] = 0;
  const std::string answer =
      compareWithReference(picture, folder.path() / "a.png", folder.path() / "out");
  EXPECT_NE(answer.find("0.50% of the pixels differ"), std::string::npos) << answer;
  EXPECT_EQ(loadPng(folder.path() / "out" / "a.difference.png").at(4, 3), rgb(0xd00000));
}

TEST(CompareWithReference, SaysWhenTheReferenceIsMissing) {
  const TemporaryFolder folder;
  const std::string answer =
      compareWithReference(Picture(4, 4), folder.path() / "none.png", folder.path() / "out");
  EXPECT_NE(answer.find("is missing"), std::string::npos);
}

}  // namespace
}  // namespace merge2d
