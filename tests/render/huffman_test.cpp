#include "render/huffman.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace merge2d {
namespace {

/// 1 for a code that uses all its room and has no two readings (Kraft's equality).
double kraftSum(const std::vector<std::uint8_t>& lengths) {
  double sum = 0.0;
  for (const std::uint8_t length : lengths) sum += length > 0 ? std::ldexp(1.0, -length) : 0.0;
  return sum;
}

TEST(Huffman, RareSymbolsHaveLongerCodes) {
  const std::vector<std::uint32_t> counts{5, 9, 12, 13, 16, 45};
  EXPECT_EQ(huffmanLengths(counts, 15), (std::vector<std::uint8_t>{4, 4, 3, 3, 3, 1}))
      << "the example of Cormen et al., Introduction to Algorithms, section 16.3";
}

TEST(Huffman, SymbolsThatDoNotOccurHaveNoCode) {
  const std::vector<std::uint32_t> counts{0, 3, 0, 3};
  EXPECT_EQ(huffmanLengths(counts, 15), (std::vector<std::uint8_t>{0, 1, 0, 1}));
  const std::vector<std::uint32_t> one{0, 7};
  EXPECT_EQ(huffmanLengths(one, 15), (std::vector<std::uint8_t>{0, 1}));
}

TEST(Huffman, NoCodeIsLongerThanTheLimit) {
  std::vector<std::uint32_t> fibonacci{1, 1};
  while (fibonacci.size() < 40) fibonacci.push_back(fibonacci.rbegin()[0] + fibonacci.rbegin()[1]);
  EXPECT_EQ(std::ranges::max(huffmanLengths(fibonacci, 64)), 39) << "the deepest tree there is";
  const std::vector<std::uint8_t> limited = huffmanLengths(fibonacci, 15);
  EXPECT_LE(std::ranges::max(limited), 15);
  EXPECT_EQ(kraftSum(limited), 1.0);
}

TEST(Huffman, CodesAreThoseOfTheStandard) {
  // RFC 1951, section 3.2.2: A to H are 010, 011, 100, 101, 110, 00, 1110, 1111; here reversed.
  const std::vector<std::uint8_t> lengths{3, 3, 3, 3, 3, 2, 4, 4};
  EXPECT_EQ(huffmanCodes(lengths),
            (std::vector<std::uint16_t>{0b010, 0b110, 0b001, 0b101, 0b011, 0b00, 0b0111, 0b1111}));
}

}  // namespace
}  // namespace merge2d
