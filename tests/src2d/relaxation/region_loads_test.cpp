#include "src2d/relaxation/region_loads.h"

#include "tests/src2d/relaxation/merged_testing.h"

namespace merge2d {
namespace {

/// A column whose upper box has the lower number.
Merged twoBoxes() {
  Scene scene = onGround();
  add(scene, box(1, 1, {0.0, 1.5}));
  add(scene, box(1, 1, {0.0, 0.5}));
  return Merged(scene);
}

/// The lower box passes a push on the upper one on, and is lifted by more than its weight.
TEST(RegionLoads, FindThePushThatNoContactCarriesAndLeaveTheImpulsesAlone) {
  Merged merged = twoBoxes();
  Collection& c = merged.collection();
  std::vector<Impulses> held;
  for (const ContactBlock& k : c.blocks) held.push_back(k.lambda);
  const auto slot = static_cast<std::uint32_t>(merged.state().collections.slotOf(c));
  merged.scratch().outer_loads = {{.slot = slot, .member = 0, .impulse = {0.0, -5.0}},
                                  {.slot = slot, .member = 1, .impulse = {0.0, 50.0}}};
  const std::vector<std::uint32_t> both{0, 1}, lifted{1};
  EXPECT_EQ(findDisturbed(merged.state(), merged.scratch(), c, true), lifted);
  EXPECT_EQ(findDisturbed(merged.state(), merged.scratch(), c, false), both);
  for (std::size_t i = 0; i < held.size(); ++i) EXPECT_EQ(c.blocks[i].lambda, held[i]);
}

}  // namespace
}  // namespace merge2d
