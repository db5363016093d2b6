#include "lessons/tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace merge2d {
namespace {

TEST(TextTable, PutsNumbersToTheRightAndTextToTheLeft) {
  TextTable table({"body", "v"});
  table.add({"a", "0.5"});
  table.add({"longer", "12.25"});
  EXPECT_EQ(table.text(10),
            "body    v\n"
            "a         0.5\n"
            "longer  12.25\n");
}

TEST(TextTable, ShowsTheMostInterestingRowsAndCountsTheOthers) {
  TextTable table({"n"});
  table.add({"one"}, 1.0);
  table.add({"two"}, 2.0);
  table.add({"three"}, 3.0);
  EXPECT_EQ(table.text(2), "n\nthree\ntwo\n… and 1 more\n");
}

TEST(TextTable, CountsLettersRatherThanBytes) {
  TextTable table({"λ_n", "x"});
  table.add({"a", "b"});
  EXPECT_EQ(table.text(2), "λ_n  x\na    b\n");
}

TEST(TextTable, SaysWhenThereIsNothing) { EXPECT_EQ(TextTable({"a"}).text(3), "(none)\n"); }

TEST(RowFilter, KeepsABodyOrAPair) {
  RowFilter filter;
  EXPECT_TRUE(filter.wants(BodyId{1}, BodyId{2}));
  filter.body = BodyId{1};
  EXPECT_TRUE(filter.wants(BodyId{1}, BodyId{2}));
  EXPECT_FALSE(filter.wants(BodyId{3}, BodyId{2}));
  filter.pair = {BodyId{1}, BodyId{2}};
  EXPECT_TRUE(filter.wants(BodyId{2}, BodyId{1}));
  EXPECT_FALSE(filter.wants(BodyId{1}, BodyId{3}));
}

}  // namespace
}  // namespace merge2d
