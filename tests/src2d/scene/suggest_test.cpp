#include "src2d/core/suggest.h"

#include <gtest/gtest.h>

#include <array>

namespace merge2d {
namespace {

TEST(Suggest, EditDistanceCountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(editDistance("", ""), 0u);
  EXPECT_EQ(editDistance("abc", ""), 3u);
  EXPECT_EQ(editDistance("friction", "frction"), 1u);
  EXPECT_EQ(editDistance("friction", "frictoin"), 1u);
  EXPECT_EQ(editDistance("kitten", "sitting"), 3u);
  EXPECT_EQ(editDistance("Mass", "mass"), 0u);
}

TEST(Suggest, EditDistanceIsSymmetric) {
  const std::array<std::string_view, 5> words{"mass", "motion", "at", "friction", "angle"};
  for (const auto a : words) {
    for (const auto b : words) EXPECT_EQ(editDistance(a, b), editDistance(b, a));
  }
}

TEST(Suggest, OnlyWhatIsNearIsSuggested) {
  const std::array<std::string_view, 3> keys{"friction", "velocity", "at"};
  EXPECT_EQ(didYouMean("velocty", keys), " (did you mean 'velocity'?)");
  EXPECT_EQ(didYouMean("Friction", keys), " (did you mean 'friction'?)");
  EXPECT_EQ(didYouMean("temperature", keys), "");
  EXPECT_EQ(didYouMean("x", keys), "") << "a single letter resembles every short word";
  EXPECT_EQ(didYouMean(std::string(100'000, 'a'), keys), "");
}

TEST(Suggest, APluralMeansItsWord) {
  const std::array<std::string_view, 3> keys{"boy", "body", "velocity"};
  EXPECT_EQ(nearest("bodies", keys), "body");
  EXPECT_EQ(nearest("Bodys", keys), "body");
  EXPECT_EQ(nearest("velocities", keys), "velocity");
  EXPECT_EQ(nearest("body", std::array<std::string_view, 2>{"kind", "bodies"}), "bodies");
}

TEST(Suggest, AnAbbreviationMeansItsWord) {
  const std::array<std::string_view, 3> keys{"restitution", "--output", "iterations"};
  EXPECT_EQ(nearest("--out", keys), "--output");
  EXPECT_EQ(nearest("restit", keys), "restitution");
  EXPECT_EQ(nearest("--o", keys), "") << "too short to tell";
  EXPECT_EQ(nearest("rest", keys), "") << "less than half of it";
}

}  // namespace
}  // namespace merge2d
