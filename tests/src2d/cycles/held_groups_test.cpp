#include "src2d/cycles/held_groups.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "src2d/cycles/rigid.h"
#include "src2d/cycles/triangle.h"

namespace merge2d {
namespace {

using testing::ElementsAre;
using Pins = std::vector<Pin>;

/// `contacts` pins between two nodes, in places that depend on the nodes.
struct Touch {
  std::uint32_t a = 0, b = 0;
  int contacts = 1;
};

Pins pinsOf(const std::vector<Touch>& touches) {
  Pins pins;
  for (const Touch& t : touches) {
    for (int i = 0; i < t.contacts; ++i) {
      pins.push_back({t.a, t.b, {t.a + 0.7 * t.b, 0.3 * t.a * t.b + i}, true});
    }
  }
  return pins;
}

Groups triangle(std::uint32_t nodes, const std::vector<Touch>& touches) {
  return heldGroups(nodes, pinsOf(touches), CycleCriterion::Triangle);
}
Groups rigid(std::uint32_t nodes, const std::vector<Touch>& touches) {
  return heldGroups(nodes, pinsOf(touches), CycleCriterion::Rigid);
}

TEST(Cycles, TwoContactsHold) {
  EXPECT_THAT(triangle(2, {{0, 1, 2}}), ElementsAre(0, 0));
  EXPECT_THAT(rigid(2, {{0, 1, 2}}), ElementsAre(0, 0));
}

TEST(Cycles, OneContactIsAPivot) {
  EXPECT_THAT(triangle(2, {{0, 1, 1}}), ElementsAre(0, 1));
  EXPECT_THAT(rigid(2, {{0, 1, 1}}), ElementsAre(0, 1));
}

TEST(Cycles, OneContactHoldsWhenTheCriterionIsOff) {
  EXPECT_THAT(heldGroups(3, pinsOf({{0, 1, 1}}), CycleCriterion::Off), ElementsAre(0, 0, 2));
}

TEST(Cycles, ThreeBodiesOfOneContactEachHold) {
  EXPECT_THAT(triangle(4, {{0, 1}, {1, 2}, {0, 2}}), ElementsAre(0, 0, 0, 3));
  EXPECT_THAT(rigid(4, {{0, 1}, {1, 2}, {0, 2}}), ElementsAre(0, 0, 0, 3));
}

TEST(Cycles, FourBodiesInARingDoNot) {
  EXPECT_THAT(triangle(4, {{0, 1}, {1, 2}, {2, 3}, {0, 3}}), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(rigid(4, {{0, 1}, {1, 2}, {2, 3}, {0, 3}}), ElementsAre(0, 1, 2, 3));
}

TEST(Cycles, ARingOfFourWithOneFirmSideIsATriangle) {
  EXPECT_THAT(triangle(4, {{0, 1, 2}, {1, 2}, {2, 3}, {0, 3}}), ElementsAre(0, 0, 0, 0));
  EXPECT_THAT(rigid(4, {{0, 1, 2}, {1, 2}, {2, 3}, {0, 3}}), ElementsAre(0, 0, 0, 0));
}

TEST(Cycles, SingleContactsOfOneBodyWithAFirmGroupAddUp) {
  // A disc in a groove of two boxes that are welded to each other.
  EXPECT_THAT(triangle(3, {{0, 1, 2}, {0, 2}, {1, 2}}), ElementsAre(0, 0, 0));
}

TEST(Cycles, ThreeLinksHoldForTheRigidCriterionAlone) {
  const std::vector<Touch> links{{0, 2}, {1, 2}, {0, 3}, {1, 3}, {0, 4}, {1, 4}};
  EXPECT_THAT(triangle(5, links), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(rigid(5, links), ElementsAre(0, 0, 0, 0, 0));
}

TEST(Cycles, ContactsInOneSpotAreOnePivot) {
  const Pins pins{{0, 1, {1, 1}, true}, {0, 1, {1, 1}, true}};
  EXPECT_THAT(heldGroups(2, pins, CycleCriterion::Triangle), ElementsAre(0, 0));
  EXPECT_THAT(heldGroups(2, pins, CycleCriterion::Rigid), ElementsAre(0, 1));
}

TEST(Cycles, OfNothingAreSingleBodies) { EXPECT_THAT(triangle(3, {}), ElementsAre(0, 1, 2)); }

/// Joining firm pairs first changes nothing.
RC_GTEST_PROP(Cycles, AreWhatTheTheorySays, ()) {
  const auto nodes = *rc::gen::inRange<std::uint32_t>(2, 9);
  std::vector<Touch> touches(*rc::gen::inRange<std::size_t>(0, 14));
  for (Touch& t : touches) {
    t.a = *rc::gen::inRange<std::uint32_t>(0, nodes);
    t.b = (t.a + *rc::gen::inRange<std::uint32_t>(1, nodes)) % nodes;
    t.contacts = *rc::gen::inRange(1, 3);
  }
  const Pins pins = pinsOf(touches);
  RC_ASSERT(heldGroups(nodes, pins, CycleCriterion::Triangle) ==
            triangleGroups(nodes, pins).groups);
  RC_ASSERT(heldGroups(nodes, pins, CycleCriterion::Rigid) == rigidGroups(nodes, pins));
}

}  // namespace
}  // namespace merge2d
