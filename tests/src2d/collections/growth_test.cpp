/// Collections that grow by little, and go on in the layout that they had.

#include <algorithm>
#include <set>

#include "src2d/collections/collection.h"
#include "src2d/collections/inner_push.h"
#include "src2d/proofs/proof_columns.h"
#include "src2d/state_file.h"
#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

/// A wall on which boxes land, one after the other; with `carried`, on a platform that moves to and
/// fro. With so many iterations it counts as large.
std::string rainedOn(bool carried) {
  const std::string motion =
      carried ? "\"scripted\"\nscript = { axis = [1, 0], amplitude = 0.05, period = 5 }"
              : "\"pinned\"";
  return R"(
format = 1
solver.iterations = 100
[material]
friction = 0.8
[[body]]
name = "platform"
at = [0, 0]
box = [14, 1]
motion = )" +
         motion + R"(
[[body]]
name = "brick"
at = [-4.8, 0.75]
box = [0.8, 0.5]
repeat = { count = [12, 12], spacing = [0.82, 0.5], stagger = 0.5 }

[[emitter]]
name = "pebble"
at = [0, 7.0]
spread = [3.0, 0.2]
every = 0.35
count = 24
box = [0.3, 0.2]
)";
}

class Growth : public testing::TestWithParam<bool> {
 protected:
  World start() const {
    return World(parseScene(rainedOn(GetParam()), "rained_on.toml"),
                 {.mode = Mode::Merge, .timings = false});
  }
};

bool hasGrown(const Collection& c) { return c.laid_out.sorted_welds < c.welds.size(); }

/// The largest collection of a world, as it is and as it would be laid out as a whole.
struct Both {
  explicit Both(World& world) {
    for (merge2d::Setup* setup : {&grown, &whole}) {
      setUp(world.scene(), Mode::Merge, *setup);
      restoreState(world.save(), "world", world.scene(), *setup);
    }
    Collection& c = largest(whole);
    c.block_contact.clear();
    c.stale = true;
    layOutCollections(whole.state);
  }
  static Collection& largest(merge2d::Setup& of) {
    return *std::ranges::max_element(of.state.collections, {},
                                     [](const Collection& c) { return c.members.size(); });
  }

  merge2d::Setup grown, whole;
};

TEST_P(Growth, IsALayoutOfTheWholeInAnotherOrder) {
  World world = start();
  int compared = 0;
  for (int step = 0; step < 1200; ++step) {
    world.step();
    if (std::ranges::none_of(world.events(), [](auto& e) { return e.type == EventType::Merge; })) {
      continue;
    }
    Both both(world);
    const Collection &grown = Both::largest(both.grown), &whole = Both::largest(both.whole);
    if (!hasGrown(grown)) continue;
    ++compared;
    ASSERT_FALSE(hasGrown(whole));
    EXPECT_EQ(grown.members.front(), whole.members.front()) << "it keeps its name";
    ASSERT_EQ(std::set(grown.members.begin(), grown.members.end()),
              std::set(whole.members.begin(), whole.members.end()));
    EXPECT_EQ(grown.laid_out.points, whole.laid_out.points);
    const Rigid &one = both.grown.state[grown.rigid], &other = both.whole.state[whole.rigid];
    EXPECT_NEAR(one.mass, other.mass, 1e-9 * other.mass);
    EXPECT_NEAR(one.inertia, other.inertia, 1e-9 * other.inertia);
    const Aabb &bounds = both.grown.state.extent(one).bounds,
               &of_whole = both.whole.state.extent(other).bounds;
    EXPECT_EQ(bounds.lower, of_whole.lower);
    EXPECT_EQ(bounds.upper, of_whole.upper);
    for (const Weld& weld : grown.welds) {
      for (const auto& [body, node] : {std::pair(weld.a, weld.node_a), {weld.b, weld.node_b}}) {
        const bool on_frame = node == grown.members.size();
        EXPECT_TRUE(on_frame ? both.grown.state[body].rigid != grown.rigid
                             : grown.members[node] == body);
      }
    }
  }
  EXPECT_GT(compared, 10);
}

/// At some instants: takes a member out of the largest collection, and calls `visit(state, id,
/// member)` where proofs are left. `choose(collection)` says which. Returns how often.
template <class Choose, class Visit>
int forEachTakenOut(World world, Choose&& choose, Visit&& visit) {
  int visited = 0;
  for (double time = 8.0; time < 12.0; time += 0.5) {
    while (world.time() < time) world.step();
    merge2d::Setup setup;
    setUp(world.scene(), Mode::Merge, setup);
    restoreState(world.save(), "world", world.scene(), setup);
    State& state = setup.state;
    const RigidId id = Both::largest(setup).rigid;
    const BodyId member = choose(state.collection(id));
    std::vector<std::uint32_t> part(state.collection(id).members.size(), 0);
    part[state[rigidOf(member)].member] = 1;
    splitCollection(state, id, part, {1, 0});
    layOutCollections(state);
    EXPECT_FALSE(hasGrown(state.collection(id)));
    if (!hasProofs(state.collection(id))) continue;
    visit(state, id, member);
    ++visited;
  }
  return visited;
}

void joinAgain(State& state, RigidId id, BodyId member) {
  mergeRigids(state, id, rigidOf(member));
  EXPECT_EQ(state.firstBody(id), std::ranges::min(state.collection(id).members));
  absorbContacts(state);
  layOutCollections(state);
}

/// The push that a growth adds to is the one that a pass over all blocks gives.
TEST_P(Growth, KeepsThePushOfTheImpulsesInside) {
  const auto last = [](const Collection& c) { return c.members.back(); };
  const int compared = forEachTakenOut(start(), last, [](State& state, RigidId id, BodyId member) {
    layOutPush(state, state.collection(id));
    joinAgain(state, id, member);
    Collection& c = state.collection(id);
    ASSERT_TRUE(hasGrown(c));
    const std::vector<Twist> kept = c.push.of;
    ASSERT_EQ(kept.size(), c.members.size());
    c.push.forget();
    layOutPush(state, c);
    for (std::size_t m = 0; m < kept.size(); ++m) {
      EXPECT_EQ(kept[m].vx, c.push.of[m].vx) << m;
      EXPECT_EQ(kept[m].vy, c.push.of[m].vy) << m;
      EXPECT_EQ(kept[m].omega, c.push.of[m].omega) << m;
    }
  });
  EXPECT_GT(compared, 2);
}

/// The lowest member names a collection, so all places change where one with a lower number joins:
/// also while the blocks are put away.
TEST_P(Growth, AMemberWithALowerNumberComesFirst) {
  const auto first = [](const Collection& c) { return c.members.front(); };
  const int compared = forEachTakenOut(start(), first, [](State& state, RigidId id, BodyId member) {
    putBlocksAway(state.collection(id));
    const std::vector<InternalContact> before = state.collection(id).contacts;
    joinAgain(state, id, member);
    const Collection& c = state.collection(id);
    EXPECT_EQ(c.members.front(), member);
    EXPECT_TRUE(std::ranges::is_sorted(c.members));
    EXPECT_EQ(c.certificate.size(), 1u) << "the proofs are carried over";
    for (const InternalContact& inner : before) {
      const auto now = std::ranges::find(c.contacts, inner.key, &InternalContact::key);
      ASSERT_NE(now, c.contacts.end());
      EXPECT_EQ(c.blocks[now->block].lambda, inner.impulses());
    }
  });
  EXPECT_GT(compared, 2);
}

TEST_P(Growth, GoesOnTheSameFromAnyStep) {
  World world = start();
  int grown = 0;
  for (int step = 0; step < 800; ++step) {
    world.step();
    if (step % 20 != 0) continue;
    const std::string bytes = world.save();
    World resumed = start();
    ASSERT_NO_THROW(resumed.restore(bytes, "test")) << step;
    ASSERT_TRUE(resumed.save() == bytes) << step;
    World goes_on = start();
    goes_on.restore(bytes, "test");
    for (int i = 0; i < 20; ++i) resumed.step(), goes_on.step();
    EXPECT_TRUE(resumed.save() == goes_on.save()) << step;
    grown += std::ranges::any_of(resumed.events(), [](auto&) { return true; }) ? 1 : 0;
  }
  EXPECT_GT(grown, 0);
}

/// A grown collection comes apart like any other: nothing is lost, and each part is in order.
TEST_P(Growth, ComesApartWhereItWasJoined) {
  World world = start();
  merge2d::Setup setup;
  setUp(world.scene(), Mode::Merge, setup);
  const auto look = [&] {
    restoreState(world.save(), "world", world.scene(), setup);
    return hasGrown(Both::largest(setup));
  };
  while (world.time() < 5.0 || (world.time() < 10.0 && !look())) world.step();
  ASSERT_TRUE(look());
  State& state = setup.state;
  Collection& c = Both::largest(setup);
  const std::size_t members = c.members.size();
  const RigidId id = c.rigid;
  std::vector<std::uint32_t> part(members, 0);
  for (std::uint32_t m = 0; m < members; ++m) part[m] = state[c.members[m]].local.x() > 0.0;
  const auto out = splitCollection(state, id, part, {1, 1});
  layOutCollections(state);
  ASSERT_EQ(out.size(), 2u);
  std::size_t all = 0;
  for (const RigidId of : out) {
    const Collection& half = state.collection(of);
    all += half.members.size();
    EXPECT_TRUE(std::ranges::is_sorted(half.members));
    EXPECT_FALSE(hasGrown(half));
    for (const InternalContact& inner : half.contacts) {
      EXPECT_TRUE(state[inner.key.a].rigid == of || state[inner.key.b].rigid == of);
    }
  }
  EXPECT_EQ(all, members);
}

INSTANTIATE_TEST_SUITE_P(Frames, Growth, testing::Bool(), [](const auto& of) {
  return std::string(of.param ? "OnAPlatform" : "OnTheGround");
});

}  // namespace
}  // namespace merge2d
