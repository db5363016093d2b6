#include "src2d/dynamics/parked.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "src2d/dynamics/collection_table.h"

namespace merge2d {
namespace {

using Pairs = ParkedPairs<int>;

std::vector<int> taken(Pairs& pairs, RigidId id) {
  std::vector<int> found;
  pairs.take(id, [&](int pair, RigidId) { found.push_back(pair); });
  std::ranges::sort(found);
  return found;
}

TEST(ParkedPairs, AreFoundByEitherEndAndOnce) {
  Pairs pairs;
  pairs.add(12, RigidId{1}, RigidId{2});
  pairs.add(13, RigidId{1}, RigidId{3});
  pairs.add(23, RigidId{2}, RigidId{3});
  pairs.add(2, Pairs::kNobody, RigidId{2});
  EXPECT_EQ(taken(pairs, RigidId{3}), (std::vector{13, 23}));
  EXPECT_EQ(taken(pairs, RigidId{2}), (std::vector{2, 12}));
  EXPECT_TRUE(taken(pairs, RigidId{1}).empty());
  EXPECT_TRUE(pairs.empty());
}

TEST(ParkedPairs, NameTheOtherEnd) {
  Pairs pairs;
  pairs.add(12, RigidId{1}, RigidId{2});
  pairs.add(1, RigidId{1}, Pairs::kNobody);
  pairs.take(RigidId{1}, [](int pair, RigidId other) {
    EXPECT_EQ(other, pair == 12 ? RigidId{2} : Pairs::kNobody);
  });
}

TEST(ParkedPairs, AreAllVisitedOnce) {
  Pairs pairs;
  pairs.add(12, RigidId{1}, RigidId{2});
  pairs.add(20, RigidId{2}, Pairs::kNobody);
  pairs.add(7, Pairs::kNobody, RigidId{7});
  pairs.add(31, RigidId{3}, RigidId{1});
  taken(pairs, RigidId{7});
  std::vector<int> all;
  pairs.forEach([&](int pair) { all.push_back(pair); });
  std::ranges::sort(all);
  EXPECT_EQ(all, (std::vector{12, 20, 31}));
}

TEST(CollectionTable, ALoopVisitsWhatIsNotSetAside) {
  CollectionTable table;
  for (int i = 0; i < 4; ++i) {
    table.append();
    table[static_cast<std::size_t>(i)].id = CollectionId{i};
  }
  table.setAside(1);
  const auto visited = [&] {
    std::vector<int> ids;
    for (const Collection& c : table) ids.push_back(value(c.id));
    return ids;
  };
  EXPECT_EQ(visited(), (std::vector{0, 2, 3}));
  table.dropLast(1);
  EXPECT_EQ(visited(), (std::vector{0, 2}));
  table.bringBack(1);
  table.append();
  EXPECT_EQ(visited().size(), 4u);
  EXPECT_EQ(table.size(), 4u);
}

}  // namespace
}  // namespace merge2d
