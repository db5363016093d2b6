/// Collections are what hangs together by welds, whatever happens.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

/// Components of the weld graph, of members alone: as sets of ids.
std::set<std::vector<BodyId>> weldComponents(const Snapshot& now, const World& world) {
  const auto member = [&](BodyId b) { return now.bodies[index(b)].collection != kNoCollection; };
  std::vector<std::size_t> root(world.bodies().size());
  for (std::size_t i = 0; i < root.size(); ++i) root[i] = i;
  const auto find = [&](BodyId b) {
    std::size_t i = index(b);
    while (root[i] != i) i = root[i];
    return i;
  };
  for (const WeldView& weld : now.welds) {
    if (member(weld.a) && member(weld.b)) root[find(weld.a)] = find(weld.b);
  }
  std::map<std::size_t, std::vector<BodyId>> parts;
  for (const BodyState& b : now.bodies) {
    if (member(b.id)) parts[find(b.id)].push_back(b.id);
  }
  std::set<std::vector<BodyId>> result;
  for (auto& [_, bodies] : parts) result.insert(bodies);
  return result;
}

class Lively : public testing::TestWithParam<int> {};

TEST_P(Lively, CollectionsAreTheComponentsOfTheWeldsAtEveryStep) {
  Simulation run(kGround + R"(
[[body]]
name = "wall"
at = [0, 0.5]
box = [1, 1]
repeat = { count = [4, 5], spacing = [1.02, 1], stagger = 0.5 }
[[body]]
name = "ball"
at = [-12, 2.2]
circle = 0.4
velocity = [12, 1]
mass = 4
[[emitter]]
name = "rain"
every = 0.1
count = 15
at = [1.5, 8]
spread = [3, 0]
box = [0.6, 0.4]
)",
                 Mode::MergeSleep, {{"seed", std::to_string(GetParam())}});
  std::set<CollectionId> alive, gone;
  int most = 0;
  run.steps(500, [&] {
    const Snapshot now = run.now();
    std::set<std::vector<BodyId>> collections;
    std::set<CollectionId> ids;
    for (const CollectionView& c : now.collections) {
      collections.insert(c.bodies);
      ids.insert(c.id);
      ASSERT_FALSE(gone.contains(c.id)) << "an id is used twice";
      for (const BodyId b : c.bodies) ASSERT_EQ(now.bodies[index(b)].collection, c.id);
      ASSERT_GE(c.bodies.size(), c.anchored ? 1u : 2u);
    }
    ASSERT_EQ(weldComponents(now, run.world()), collections) << "in step " << now.step;
    for (const CollectionId id : alive) {
      if (!ids.contains(id)) gone.insert(id);
    }
    alive = ids;
    most = std::max(most, static_cast<int>(ids.size()));
  });
  EXPECT_GE(most, 2);
  EXPECT_GT(run.count(EventType::Merge), 10);
  EXPECT_GT(run.count(EventType::Unmerge), 3);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Lively, testing::Values(1, 2, 3));

/// A wall of any size and mass that any ball hits, under some rain; each run is another one.
Scene anyStorm() {
  const int rows = *rc::gen::inRange(1, 6), columns = *rc::gen::inRange(1, 6);
  Scene scene = wall(rows, columns);
  for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
    scene.bodies[i].friction = 0.1 * *rc::gen::inRange(1, 9);
    scene.bodies[i].density = 0.25 * *rc::gen::inRange(1, 9);
  }
  BodyDesc ball = disc(0.4, {-6.0 - columns, 0.1 * *rc::gen::inRange(5, 45)});
  ball.velocity = {0.5 * *rc::gen::inRange(2, 40), 2.0};
  add(scene, std::move(ball));
  const int drops = *rc::gen::inRange(0, 6);
  for (int i = 0; i < drops; ++i) {
    const Vec2 at(0.1 * *rc::gen::inRange(-30, 30), rows + 1.0 + 1.2 * i);
    BodyDesc drop = box(0.6, 0.4, at);
    drop.angle = 0.1 * *rc::gen::inRange(0, 31);
    add(scene, std::move(drop));
  }
  return scene;
}

RC_GTEST_PROP(Storm, CollectionsAreTheComponentsOfTheWeldsAtEveryStep, ()) {
  const Mode mode = *rc::gen::element(Mode::Merge, Mode::MergeSleep);
  Simulation run(anyStorm(), mode);
  run.steps(250, [&] {
    const Snapshot now = run.now();
    std::set<std::vector<BodyId>> collections;
    for (const CollectionView& c : now.collections) collections.insert(c.bodies);
    RC_ASSERT(collections == weldComponents(now, run.world()));
  });
}

}  // namespace
}  // namespace merge2d
