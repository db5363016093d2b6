/// The built-in scenes about cycles, under each criterion, beside the reference: a weld may only be
/// where the reference stays still for the next five seconds.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "src2d/scene/load.h"
#include "src2d/world.h"

namespace merge2d {
namespace {

constexpr int kSteps = 500;      // of the merged run
constexpr int kStill = 500;      // five seconds
constexpr double kMoved = 0.02;  // m, or rad

/// Where b is, seen from a.
Pose seenFrom(const Snapshot& s, BodyId a, BodyId b) {
  return s.bodies[index(a)].pose().inverse() * s.bodies[index(b)].pose();
}

struct Runs {
  std::vector<BodyInfo> bodies;
  std::vector<Snapshot> reference, merged;

  const std::string& name(BodyId id) const { return bodies[index(id)].name; }

  /// How far a pair moves in the reference in the five seconds after a step.
  double movesAfter(std::size_t step, BodyId a, BodyId b) const {
    const Pose before = seenFrom(reference[step], a, b);
    double most = 0.0;
    for (std::size_t k = step; k < std::min(step + kStill, reference.size()); k += 20) {
      const Pose now = seenFrom(reference[k], a, b);
      most = std::max({most, (now.position - before.position).norm(),
                       std::abs((before.rotation.inverse() * now.rotation).angle())});
    }
    return most;
  }
};

std::vector<Snapshot> run(const Scene& scene, Mode mode, int steps) {
  World world(scene, {.mode = mode, .timings = false});
  std::vector<Snapshot> all;
  for (int k = 0; k < steps; ++k) {
    world.step();
    all.push_back(world.capture());
  }
  return all;
}

Runs runBoth(const std::string& name, const std::string& criterion) {
  const Scene scene = loadScene(name, {{"merging.cycles", criterion}});
  Runs runs;
  runs.bodies = World(scene).bodies();
  runs.reference = run(scene, Mode::Reference, kSteps + kStill);
  runs.merged = run(scene, Mode::Merge, kSteps);
  return runs;
}

/// The pairs that were ever welded, "a - b".
std::set<std::string> weldsOf(const Runs& runs) {
  std::set<std::string> welds;
  for (const Snapshot& s : runs.merged) {
    for (const WeldView& w : s.welds) welds.insert(runs.name(w.a) + " - " + runs.name(w.b));
  }
  return welds;
}

class CycleScenes : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(CycleScenes, AreWeldedOnlyWhereTheReferenceStaysStill) {
  const auto& [scene, criterion] = GetParam();
  const Runs runs = runBoth(scene, criterion);
  for (std::size_t step = 0; step < runs.merged.size(); ++step) {
    for (const WeldView& w : runs.merged[step].welds) {
      ASSERT_LT(runs.movesAfter(step, w.a, w.b), kMoved)
          << runs.name(w.a) << " and " << runs.name(w.b) << " at step " << step + 1;
    }
  }
  EXPECT_FALSE(weldsOf(runs).empty());
}

INSTANTIATE_TEST_SUITE_P(Scenes, CycleScenes,
                         testing::Combine(testing::Values("three-discs", "arch", "tripod",
                                                          "box-on-points", "ladder", "truss-arch",
                                                          "planks"),
                                          testing::Values("triangle", "rigid")),
                         [](const auto& of) {
                           std::string name = std::get<0>(of.param) + "_" + std::get<1>(of.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(TrussArch, ThreeBodiesHoldAndFourDoNotUnlessTheCriterionIsOff) {
  for (const std::string criterion : {"triangle", "rigid"}) {
    const Runs runs = runBoth("truss-arch", criterion);
    EXPECT_TRUE(weldsOf(runs).contains("left-leg - right-leg")) << criterion;
    // The linkage of four is never welded while it is one.
    for (std::size_t step = 0; step < 100; ++step) {
      for (const WeldView& w : runs.merged[step].welds) {
        for (const BodyId id : {w.a, w.b}) {
          EXPECT_THAT(runs.name(id),
                      testing::Not(testing::AnyOf("lintel", "left-post", "right-post")))
              << criterion << ", step " << step + 1;
        }
      }
    }
  }
}

TEST(TrussArch, TheDecisionsNameTheGroup) {
  const Scene scene = loadScene("truss-arch");
  World world(scene, {.mode = Mode::Merge, .timings = false, .decisions = true});
  std::set<std::string> group;
  for (int k = 0; k < kSteps && group.empty(); ++k) {
    world.step();
    const Snapshot s = world.capture();
    for (const Decision& d : s.decisions) {
      if (d.stage != "Merge" || d.criterion != "cycle") continue;
      EXPECT_EQ(d.group >= 0, d.verdict == "merge");
      if (d.group != 0) continue;  // body 0 is the ground
      group.insert(world.bodies()[index(d.a)].name + " - " + world.bodies()[index(d.b)].name);
    }
  }
  EXPECT_THAT(group, testing::ElementsAre("ground - left-leg", "ground - right-leg",
                                          "left-leg - right-leg"));
}

}  // namespace
}  // namespace merge2d
