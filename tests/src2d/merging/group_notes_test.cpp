/// Which group the decisions of the cycle criterion name.

#include "src2d/merging/group_notes.h"

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

std::vector<std::string> namesOf(const World& world, const Group& group) {
  std::vector<std::string> names;
  for (const BodyId body : group) names.push_back(world.bodies()[index(body)].name);
  return names;
}

/// The decisions of the cycle criterion in one stage of the last step.
std::vector<Decision> cycleDecisions(const Snapshot& s, std::string_view stage) {
  std::vector<Decision> found;
  for (const Decision& d : s.decisions) {
    if (d.criterion == "cycle" && d.stage == stage) found.push_back(d);
  }
  return found;
}

const Group& groupOf(const Snapshot& s, const Decision& d) {
  return s.groups.at(static_cast<std::size_t>(d.members));
}

TEST(GroupNotes, AMergeNamesAllBodiesOfTheGroup) {
  Simulation run(loadScene("truss-arch"), Mode::Merge, true);
  int named = 0;
  run.steps(10, [&] {
    const Snapshot now = run.now();
    for (const Decision& d : cycleDecisions(now, "Merge")) {
      if (d.verdict != "merge") {
        EXPECT_EQ(d.members, -1);
        continue;
      }
      EXPECT_THAT(namesOf(run.world(), groupOf(now, d)),
                  ElementsAre("ground", "left-leg", "right-leg"));
      ++named;
    }
  });
  EXPECT_EQ(named, 3);
}

TEST(GroupNotes, WhatIsWeldedAlreadyComesAfterWhatTouches) {
  // A firm pair of boxes; a disc in the groove between them touches one contact of each.
  const std::string toml = kGround + R"(
[[body]]
name = "left"
at = [-0.6, 0.5]
box = [1, 1]
[[body]]
name = "right"
at = [0.6, 0.5]
box = [1, 1]
[[body]]
name = "disc"
at = [0, 1.6]
circle = 0.3
)";
  Simulation run(toml, Mode::Merge, {}, true);
  std::vector<std::string> last;
  run.steps(200, [&] {
    const Snapshot now = run.now();
    for (const Decision& d : cycleDecisions(now, "Merge")) {
      if (d.members >= 0 && d.value < 2.0) last = namesOf(run.world(), groupOf(now, d));
    }
  });
  EXPECT_THAT(last, ElementsAre("left", "right", "disc"));
}

TEST(GroupNotes, EveryGroupHoldsItsPairAndNoBodyTwice) {
  std::string toml = kGround;
  for (int i = 0; i < 24; ++i) {
    const double x = 0.9 * (i % 4) + 0.1 * (i / 4 % 2), y = 0.5 + 0.9 * (i / 4);
    const std::string shape = i % 3 == 0 ? "circle = 0.4" : "box = [0.8, 0.6]";
    toml +=
        "[[body]]\nat = [" + std::to_string(x) + ", " + std::to_string(y) + "]\n" + shape + "\n";
  }
  Simulation run(toml, Mode::Merge, {}, true);
  int merged = 0;
  run.steps(400, [&] {
    const Snapshot now = run.now();
    for (const Decision& d : now.decisions) {
      if (d.criterion != "cycle" || d.verdict == "wait") continue;
      const Group& group = groupOf(now, d);
      EXPECT_THAT(group, Contains(d.a));
      EXPECT_THAT(group, Contains(d.b));
      EXPECT_EQ(std::set<BodyId>(group.begin(), group.end()).size(), group.size());
      EXPECT_EQ(BodyId{static_cast<std::uint32_t>(d.group)}, group.front());
      ++merged;
    }
  });
  EXPECT_GT(merged, 0);
}

TEST(GroupNotes, NobodyPaysForThemWhoDoesNotAsk) {
  Simulation run(loadScene("truss-arch"), Mode::Merge);
  run.steps(10, [&] { EXPECT_THAT(run.now().groups, IsEmpty()); });
}

}  // namespace
}  // namespace merge2d
