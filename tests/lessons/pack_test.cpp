#include "lessons/pack.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libdeflate.h>

#include <cmath>

namespace merge2d {
namespace {

using ::testing::ElementsAre;

std::string text(const std::string& bytes) {
  return base64({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

TEST(Pack, SmallNumbersOfEitherSignTakeOneByte) {
  Packer packer;
  for (const int value : {0, -1, 1, -2, 63, -64}) packer.number(value);
  EXPECT_THAT(packer.bytes(), ElementsAre(0, 1, 2, 3, 126, 127));
}

TEST(Pack, LargerNumbersTakeSevenBitsAByteTheLowOnesFirst) {
  Packer packer;
  packer.number(64);   // 128 as 0x80 0x01
  packer.number(-65);  // 129
  EXPECT_THAT(packer.bytes(), ElementsAre(0x80, 0x01, 0x81, 0x01));
}

TEST(Pack, AColumnIsItsLengthAndItsDifferences) {
  Packer packer;
  packer.column(std::vector<std::int32_t>{5, 6, 4});
  EXPECT_THAT(packer.bytes(), ElementsAre(6, 10, 2, 3));
}

TEST(Pack, RunsAreCountsAndValues) {
  Packer packer;
  packer.runs(std::vector<std::int32_t>{7, 7, 7, -1});
  EXPECT_THAT(packer.bytes(), ElementsAre(8, 6, 14, 2, 1));
}

TEST(Pack, ALogarithmicCodeKeepsTheRelativeErrorOverManyDecades) {
  const Logarithmic scale{.floor = 1e-7, .steps = 64.0};
  for (double value = 1e-5; value < 1e6; value *= 3.7) {
    for (const double signed_value : {value, -value}) {
      EXPECT_NEAR(scale.value(scale.code(signed_value)) / signed_value, 1.0, 0.0055);
    }
  }
  EXPECT_EQ(scale.code(0.0), 0);
  EXPECT_EQ(scale.code(-1e-10), 0);
}

TEST(Pack, WhatIsNoNumberDoesNoHarm) {
  EXPECT_EQ(Linear{0.1}.code(std::nan("")), 0);
  EXPECT_EQ(Linear{1e-9}.code(1e9), 2147483647);
}

TEST(Pack, Base64IsThatOfTheStandard) {  // RFC 4648, Section 10
  EXPECT_EQ(text(""), "");
  EXPECT_EQ(text("f"), "Zg==");
  EXPECT_EQ(text("fo"), "Zm8=");
  EXPECT_EQ(text("foo"), "Zm9v");
  EXPECT_EQ(text("foobar"), "Zm9vYmFy");
}

TEST(Pack, DeflatedBytesComeBack) {
  const std::vector<std::uint8_t> bytes(10'000, 42);
  const std::vector<std::uint8_t> packed = deflated(bytes);
  EXPECT_LT(packed.size(), 100u);
  std::vector<std::uint8_t> again(bytes.size());
  libdeflate_decompressor* reader = libdeflate_alloc_decompressor();
  EXPECT_EQ(libdeflate_zlib_decompress(reader, packed.data(), packed.size(), again.data(),
                                       again.size(), nullptr),
            LIBDEFLATE_SUCCESS);
  libdeflate_free_decompressor(reader);
  EXPECT_EQ(again, bytes);
}

}  // namespace
}  // namespace merge2d
