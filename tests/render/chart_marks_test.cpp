#include "render/chart_marks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace merge2d {
namespace {

constexpr float kLeft = 0.0F, kRight = 100.0F, kGap = 2.0F;

/// Marks at these columns, with names of one width.
std::vector<PlacedMark> placed(const std::vector<float>& columns, float width) {
  std::vector<PlacedMark> marks;
  for (const float column : columns) {
    PlacedMark& mark = marks.emplace_back();
    mark.column = column, mark.width = width;
  }
  placeNames(marks, kLeft, kRight, kGap);
  return marks;
}

/// No two names touch, none leaves the plot, and no line crosses a name.
void expectLegible(const std::vector<PlacedMark>& marks) {
  for (const PlacedMark& a : marks) {
    if (!a.named) continue;
    EXPECT_GE(a.start, kLeft);
    EXPECT_LE(a.start + a.width, kRight);
    EXPECT_EQ(a.at_right ? a.start + a.width : a.start, a.column);
    for (const PlacedMark& b : marks) {
      if (&a == &b || !b.named) continue;
      const bool apart = a.start + a.width + kGap <= b.start || b.start + b.width + kGap <= a.start;
      EXPECT_TRUE(a.row != b.row || apart) << a.column << " and " << b.column;
      const bool crosses = b.column > a.start && b.column < a.start + a.width && b.row >= a.row;
      EXPECT_FALSE(crosses) << b.column << " crosses " << a.column;
    }
  }
}

TEST(ChartMarks, NamesBeginAtTheirLines) {
  for (const PlacedMark& mark : placed({10.0F, 40.0F, 70.0F}, 20.0F)) {
    EXPECT_TRUE(mark.named);
    EXPECT_FALSE(mark.at_right);
    EXPECT_EQ(mark.start, mark.column);
    EXPECT_EQ(mark.row, 0U);
  }
}

TEST(ChartMarks, ANameThatWouldLeaveThePlotEndsAtItsLine) {
  const std::vector<PlacedMark> marks = placed({10.0F, 90.0F}, 20.0F);
  EXPECT_FALSE(marks[0].at_right);
  EXPECT_TRUE(marks[1].at_right);
  EXPECT_EQ(marks[1].start, 70.0F);
}

TEST(ChartMarks, NamesStandClearOfEachOtherAndOfLines) {
  for (const float width : {5.0F, 20.0F, 45.0F, 90.0F}) {
    for (int crowd = 1; crowd < 40; ++crowd) {
      std::vector<float> columns;
      for (int i = 0; i < crowd; ++i) {
        columns.push_back(static_cast<float>(i * i % 97) * 0.9F + 0.1F * static_cast<float>(i));
      }
      std::ranges::sort(columns);
      expectLegible(placed(columns, width));
    }
  }
}

TEST(ChartMarks, TheFirstOfACrowdIsAlwaysNamed) {
  for (const float first : {5.0F, 50.0F, 88.0F}) {
    std::vector<float> columns;
    for (int i = 0; i < 12; ++i) columns.push_back(first + static_cast<float>(i));
    const std::vector<PlacedMark> marks = placed(columns, 30.0F);
    EXPECT_TRUE(marks[0].named) << first;
    EXPECT_GE(std::ranges::count_if(marks, &PlacedMark::named), 4) << first;
    EXPECT_FALSE(marks.back().named) << "there is no room for so many";
  }
}

TEST(ChartMarks, LongNamesAreShortened) {
  EXPECT_EQ(shortened("short", 5), "short");
  EXPECT_EQ(shortened("longer", 5), "long…");
  EXPECT_EQ(shortened("ööööö", 5), "ööööö");
  EXPECT_EQ(shortened("öööööö", 5), "öööö…");
  EXPECT_EQ(shortened("", 5), "");
}

}  // namespace
}  // namespace merge2d
