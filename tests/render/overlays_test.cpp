#include "render/overlays.h"

#include <gtest/gtest.h>

#include "src2d/core/error.h"

namespace merge2d {
namespace {

TEST(Overlays, AreAddedToTheStandardOnes) {
  const Overlays overlays = parseOverlays("contacts, forces");
  EXPECT_TRUE(overlays.has(Overlay::Contacts));
  EXPECT_TRUE(overlays.has(Overlay::Forces));
  EXPECT_TRUE(overlays.has(Overlay::Labels));
  EXPECT_FALSE(overlays.has(Overlay::Graph));
  EXPECT_EQ(parseOverlays(""), Overlays::standard());
}

TEST(Overlays, CanStartFromNoneOrAllAndTakeAway) {
  EXPECT_EQ(parseOverlays("none"), Overlays());
  EXPECT_EQ(parseOverlays("none,scale"), Overlays().add(Overlay::Scale));
  EXPECT_FALSE(parseOverlays("-legend").has(Overlay::Legend));
  const Overlays all = parseOverlays("all,-names");
  for (const OverlayEntry& entry : kOverlayTable) {
    EXPECT_EQ(all.has(entry.overlay), entry.overlay != Overlay::Names) << entry.name;
  }
}

TEST(Overlays, TheTableNamesEachOnce) {
  for (const OverlayEntry& entry : kOverlayTable) {
    EXPECT_EQ(parseOverlays("none," + std::string(entry.name)), Overlays().add(entry.overlay));
  }
}

TEST(Overlays, AMistypedNameGetsASuggestion) {
  try {
    parseOverlays("labels,contcts");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "unknown overlay 'contcts' (did you mean 'contacts'?)");
  }
}

}  // namespace
}  // namespace merge2d
