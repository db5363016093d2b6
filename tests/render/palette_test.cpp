#include "render/palette.h"

#include <gtest/gtest.h>

#include <set>

#include "render/theme.h"
#include "tests/render/samples.h"

namespace merge2d {
namespace {

/// A snapshot with collections of one body each, side by side, 1 m apart.
samples::Sample row(const std::vector<int>& ids) {
  samples::Sample s;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    s.box({static_cast<double>(i), 0.0}, 1.0, 1.0);
    s.collect(ids[i], {samples::id(i)});
  }
  return s;
}

TEST(CollectionColors, StayForLife) {
  CollectionColors colors;
  const CollectionSlots first = colors.update(row({1, 2, 3}).snapshot);
  const std::size_t two = slotOf(first, CollectionId{2});
  for (int step = 0; step < 20; ++step) {
    const CollectionSlots now = colors.update(row({2, 10 + step, 40 + step}).snapshot);
    EXPECT_EQ(slotOf(now, CollectionId{2}), two);
  }
  // Also for one that was out of sight for a while.
  colors.update(row({99}).snapshot);
  EXPECT_EQ(slotOf(colors.update(row({2}).snapshot), CollectionId{2}), two);
}

TEST(CollectionColors, AsManyAsThereAreColoursAllDiffer) {
  const CollectionSlots slots = CollectionColors().update(row({1, 2, 3, 4, 5, 6, 7}).snapshot);
  std::set<std::size_t> used;
  for (const auto& [id, slot] : slots) used.insert(slot);
  EXPECT_EQ(used.size(), Theme::kCollections);
}

TEST(CollectionColors, TouchingNeighboursDifferAlsoWhenThereAreMany) {
  std::vector<int> ids;
  for (int i = 1; i <= 60; ++i) ids.push_back(i);
  samples::Sample s = row(ids);
  for (std::size_t i = 1; i < ids.size(); ++i) {
    s.contact(samples::id(i - 1), samples::id(i), {0.0, 0.0}, {1.0, 0.0}, 0.0);
  }
  const CollectionSlots slots = CollectionColors().update(s.snapshot);
  for (std::size_t i = 1; i < slots.size(); ++i) EXPECT_NE(slots[i - 1].second, slots[i].second);
}

TEST(CollectionColors, TakeTurnsWhenCollectionsComeAndGo) {
  CollectionColors colors;
  std::set<std::size_t> used;
  for (int id = 1; id <= 7; ++id) {
    used.insert(slotOf(colors.update(row({id}).snapshot), CollectionId{id}));
  }
  EXPECT_EQ(used.size(), Theme::kCollections - 1);
  EXPECT_FALSE(used.contains(Theme::kFaint)) << "yellow waits until the others are taken";
}

}  // namespace
}  // namespace merge2d
