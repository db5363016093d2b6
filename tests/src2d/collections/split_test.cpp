#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numeric>

#include "src2d/collections/collection.h"
#include "src2d/setup.h"
#include "tests/support/merging_testing.h"
#include "tests/support/random.h"

namespace merge2d {
namespace {

/// Boxes and discs anywhere, with any motion.
void anySetup(int count, Setup& setup) {
  Scene scene;
  scene.gravity = Vec2::Zero();
  for (int i = 0; i < count; ++i) {
    BodyDesc body;
    body.name = std::to_string(i);
    body.at = anyVec(8.0);
    body.angle = uniform(-3.0, 3.0);
    body.velocity = anyVec(3.0);
    body.spin = uniform(-3.0, 3.0);
    if (i % 3 == 0) {
      body.shapes = {Circle{{0.1, 0.2}, uniform(0.2, 1.0)}};
    } else {
      body.shapes = {makeBox(uniform(0.3, 2.0), uniform(0.3, 2.0))};
    }
    scene.bodies.push_back(body);
  }
  setUp(scene, Mode::Merge, setup);
}

struct Momentum {
  Vec2 linear = Vec2::Zero();
  double angular = 0.0, scale = 0.0;
};

/// Of everything that floats, about the world's origin.
Momentum momentum(const State& state) {
  Momentum sum;
  for (const Rigid& r : state.rigids) {
    if (!r.present()) continue;
    sum.linear += r.mass * r.v;
    sum.angular += r.inertia * r.omega + r.mass * cross(r.x, r.v);
    sum.scale += std::abs(r.inertia * r.omega) + r.mass * r.x.norm() * r.v.norm() + r.mass;
  }
  return sum;
}

void assertSame(const Momentum& before, const Momentum& after) {
  RC_ASSERT((after.linear - before.linear).norm() <= 1e-12 * before.scale);
  RC_ASSERT(std::abs(after.angular - before.angular) <= 1e-12 * before.scale);
}

std::vector<RigidId> presentRigids(const State& state) {
  std::vector<RigidId> present;
  for (std::uint32_t i = 0; i < state.rigids.size(); ++i) {
    if (state.rigids[i].present()) present.push_back(RigidId{i});
  }
  return present;
}

/// Parts numbered from 0 without gaps, at least two.
std::vector<std::uint32_t> anyParts(std::size_t members, std::uint32_t& parts) {
  parts = *rc::gen::inRange<std::uint32_t>(2, static_cast<std::uint32_t>(members) + 1);
  std::vector<std::uint32_t> part(members);
  for (std::size_t i = 0; i < members; ++i) {
    part[i] =
        i < parts ? static_cast<std::uint32_t>(i) : *rc::gen::inRange<std::uint32_t>(0, parts);
  }
  return part;
}

RC_GTEST_PROP(Split, RandomMergesAndSplitsConserveMomentumAndNeverReuseAnId, ()) {
  merge2d::Setup setup;
  anySetup(*rc::gen::inRange(3, 9), setup);
  State& state = setup.state;
  const Momentum before = momentum(state);
  std::vector<Pose> poses;
  for (std::uint32_t i = 0; i < state.bodies.size(); ++i) poses.push_back(state.pose(BodyId{i}));
  std::set<CollectionId> seen, alive;
  const auto lookAtIds = [&] {
    std::set<CollectionId> now;
    for (const Collection& c : state.collections) {
      if (c.id != kNoCollection) now.insert(c.id);
    }
    for (const CollectionId id : now) {
      RC_ASSERT(alive.contains(id) || !seen.contains(id));
    }
    seen.insert(now.begin(), now.end());
    alive = now;
  };

  for (int round = 0; round < 12; ++round) {
    const std::vector<RigidId> present = presentRigids(state);
    const RigidId any = present[*rc::gen::inRange<std::size_t>(0, present.size())];
    if (state.isCollection(any) && *rc::gen::arbitrary<bool>()) {
      const std::size_t members = state.collection(any).members.size();
      const CollectionId id = state.collection(any).id;
      std::uint32_t parts = 0;
      const auto part = anyParts(members, parts);
      const auto out = splitCollection(state, any, part, std::vector<std::uint8_t>(parts, 0));
      RC_ASSERT(out.size() == parts);
      // The largest part comes first, and keeps the id if it is more than one body.
      std::vector<std::size_t> sizes(parts, 0);
      for (const std::uint32_t p : part) ++sizes[p];
      const std::size_t largest = *std::max_element(sizes.begin(), sizes.end());
      if (largest > 1) {
        RC_ASSERT(state.collection(out.front()).id == id);
        RC_ASSERT(state.collection(out.front()).members.size() == largest);
      }
    } else {
      const RigidId other = present[*rc::gen::inRange<std::size_t>(0, present.size())];
      if (other == any) continue;
      const auto size = [&](RigidId r) {
        return state.isCollection(r) ? state.collection(r).members.size() : 1u;
      };
      const bool wins = size(any) > size(other);  // so it is a collection
      const CollectionId larger = wins ? state.collection(any).id : kNoCollection;
      const RigidId made = mergeRigids(state, any, other);
      RC_ASSERT(!wins || state.collection(made).id == larger);
    }
    layOutCollections(state);
    lookAtIds();
    assertSame(before, momentum(state));
  }
  for (std::uint32_t i = 0; i < state.bodies.size(); ++i) {
    RC_ASSERT((state.pose(BodyId{i}).position - poses[i].position).norm() < 1e-12);
    RC_ASSERT(std::abs((state.pose(BodyId{i}).rotation * poses[i].rotation.inverse()).s) < 1e-12);
  }
}

RC_GTEST_PROP(Split, PartsMoveAsTheWholeDid, ()) {
  merge2d::Setup setup;
  anySetup(6, setup);
  State& state = setup.state;
  RigidId id = mergeRigids(state, RigidId{0}, RigidId{1});
  for (std::uint32_t i = 2; i < 6; ++i) id = mergeRigids(state, id, RigidId{i});
  layOutCollections(state);
  const Rigid whole = state[id];
  std::uint32_t parts = 0;
  const auto part = anyParts(6, parts);
  for (const RigidId p : splitCollection(state, id, part, std::vector<std::uint8_t>(parts, 0))) {
    RC_ASSERT((state[p].v - whole.velocityAt(state[p].x)).norm() < 1e-12);
    RC_ASSERT(state[p].omega == whole.omega);
  }
}

TEST(Split, MassOfThePartsIsThatOfTheirMembers) {
  merge2d::Setup setup;
  setUp(parseScene(R"(
format = 1
[[body]]
name = "b"
box = [1, 1]
repeat = { count = [4, 1], spacing = [1, 1] }
)",
                   "row.toml"),
        Mode::Merge, setup);
  State& state = setup.state;
  RigidId id = mergeRigids(state, RigidId{0}, RigidId{1});
  for (std::uint32_t i = 2; i < 4; ++i) id = mergeRigids(state, id, RigidId{i});
  layOutCollections(state);
  const auto out = splitCollection(state, id, {0, 0, 0, 1}, {0, 0});
  ASSERT_EQ(out.size(), 2u);
  EXPECT_NEAR(state[out[0]].mass, 3.0, 1e-15);
  EXPECT_NEAR(state[out[0]].inertia, 3.0 / 6.0 + 2.0, 1e-14);
  EXPECT_NEAR((state[out[0]].x - Vec2(1.0, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_EQ(out[1], RigidId{3}) << "a single body is itself again";
  EXPECT_NEAR(state[out[1]].mass, 1.0, 1e-15);
  EXPECT_EQ(state[BodyId{3}].rigid, RigidId{3});
}

TEST(Split, OfAnAnchoredCollectionLeavesWhatIsNotWeldedFloating) {
  merge2d::Setup setup;
  setUp(parseScene(kGround + R"(
[[body]]
name = "b"
at = [0, 0.5]
box = [1, 1]
repeat = { count = [1, 3], spacing = [1, 1] }
)",
                   "column.toml"),
        Mode::Merge, setup);
  State& state = setup.state;
  RigidId id = anchorRigid(state, RigidId{1}, BodyId{0});
  id = mergeRigids(state, id, RigidId{2});
  id = mergeRigids(state, id, RigidId{3});
  layOutCollections(state);
  EXPECT_FALSE(state[id].floating());
  EXPECT_EQ(state[id].inv_mass, 0.0);
  const auto out = splitCollection(state, id, {0, 1, 1}, {1, 0});
  ASSERT_EQ(out.size(), 2u);
  EXPECT_TRUE(state[out[0]].floating());
  EXPECT_NEAR(state[out[0]].inv_mass, 0.5, 1e-15);
  EXPECT_NEAR((state[out[0]].x - Vec2(0.0, 2.0)).norm(), 0.0, 1e-15);
  EXPECT_FALSE(state[out[1]].floating());
  EXPECT_EQ(state.collection(out[1]).anchor, BodyId{0});
  EXPECT_EQ(state.collection(out[1]).members.size(), 1u);
}

}  // namespace
}  // namespace merge2d
