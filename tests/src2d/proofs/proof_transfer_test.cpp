#include "src2d/proofs/proof_transfer.h"

#include "src2d/collections/collection.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/state_file.h"
#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

/// A cart that swings on its springs, or a platform that is moved to and fro; on it stands a wall.
std::string swinging(bool floats) {
  const std::string platform = R"(
[[body]]
name = "platform"
at = [0, 0]
box = [8, 1]
motion = "scripted"
script = { axis = [1, 0], amplitude = 0.15, period = 5 }
)";
  return "format = 1\n[material]\nfriction = 0.8\n" + (floats ? kCartOnSprings : platform) + R"(
[[body]]
name = "box"
at = [-3.1, 0.75]
box = [0.8, 0.5]
repeat = { count = [8, 8], spacing = [0.82, 0.5], stagger = 0.5 }
)";
}

/// The state of such a world with proofs, to take apart.
class Swinging {
 public:
  explicit Swinging(bool floats)
      : world_(parseScene(swinging(floats), "swinging.toml"), {.mode = Mode::Merge}) {
    while (world_.time() < 20.0) world_.step();
    setUp(world_.scene(), Mode::Merge, setup_);
    restoreState(world_.save(), "world", world_.scene(), setup_);
  }

  State& state() { return setup_.state; }
  Collection& collection() {
    return *std::ranges::max_element(state().collections, {},
                                     [](const Collection& c) { return c.members.size(); });
  }
  const std::vector<Witness>& witnesses() { return collection().certificate.front().witnesses; }
  BodyId id(const std::string& name) const { return idOf(world_, name); }

  /// Takes bodies out of the collection.
  void free(const std::vector<BodyId>& bodies) {
    Collection& c = collection();
    std::vector<std::uint32_t> part(c.members.size(), 0);
    std::uint32_t parts = 1;
    for (const BodyId b : bodies) part[state()[rigidOf(b)].member] = parts++;
    std::vector<std::uint8_t> anchored(parts, 0);
    anchored[0] = !state()[c.rigid].floating();
    splitCollection(state(), c.rigid, part, anchored);
    layOutCollections(state());
  }
  void join(const std::vector<BodyId>& bodies) {
    for (const BodyId b : bodies) mergeRigids(state(), collection().rigid, rigidOf(b));
    absorbContacts(state());
    layOutCollections(state());
  }

  /// How fast contacts move under the load of a proof with its impulses [m/s].
  double speedUnder(const Witness& witness) {
    Collection& c = collection();
    std::vector<SolverVelocity> u(state().bodies.size() + 1);
    for (std::uint32_t m = 0; m < c.members.size(); ++m) {
      const BodyId b = c.members[m];
      if (b == c.certificate.front().heaviest) continue;
      const Twist load = loadOnMember(state(), c, witness, m);
      u[index(b)] = {.vx = load.vx,
                     .vy = load.vy,
                     .omega = load.omega,
                     .inv_mass = 1.0 / state()[b].mass,
                     .inv_inertia = 1.0 / state()[b].inertia};
    }
    double most = 0.0;
    for (std::size_t i = 0; i < c.blocks.size(); ++i) {
      ContactBlock k = c.blocks[i];
      k.lambda = witness.lambda[i];
      applyImpulses(k, u[k.a], u[k.b]);
    }
    for (const ContactBlock& k : c.blocks) {
      for (int p = 0; p < k.count; ++p) {
        const ContactVelocity w = contactVelocity(k, p, k.nx, k.ny, u[k.a], u[k.b]);
        most = std::max({most, std::abs(w.n), std::abs(w.t)});
      }
    }
    return most;
  }

  /// The velocity that forces from outside give the members in a proof, in all and at most [m/s].
  static double allOutside(const Witness& witness) {
    Vec2 all = Vec2::Zero();
    for (const Twist& u : witness.outer) all += Vec2(u.vx, u.vy);
    return all.norm();
  }
  static double mostOutside(const Witness& witness) {
    double most = 0.0;
    for (const Twist& u : witness.outer) most = std::max(most, std::hypot(u.vx, u.vy));
    return most;
  }

 private:
  World world_;
  merge2d::Setup setup_;
};

class TransferredProofs : public testing::TestWithParam<bool> {};

TEST_P(TransferredProofs, HoldWhenABodyLeaves) {
  Swinging swinging(GetParam());
  const std::size_t before = swinging.witnesses().size();
  ASSERT_GT(before, 1u);
  swinging.free({swinging.id("box[3,7]")});
  ASSERT_EQ(swinging.collection().certificate.size(), 1u);
  EXPECT_EQ(swinging.witnesses().size(), before);
  const double weight = swinging.state().h * kGravity;
  for (const Witness& witness : swinging.witnesses()) {
    EXPECT_LT(swinging.speedUnder(witness), cutSpeed(swinging.state()));
    EXPECT_NEAR(Swinging::allOutside(witness), weight, 0.1 * weight) << "of the box that has left";
  }
}

TEST_P(TransferredProofs, HoldWhenABodyComesBack) {
  Swinging swinging(GetParam());
  const std::size_t before = swinging.witnesses().size();
  const BodyId box = swinging.id("box[3,7]");
  swinging.free({box});
  swinging.join({box});
  ASSERT_EQ(swinging.collection().certificate.size(), 1u);
  EXPECT_GT(swinging.witnesses().size(), 1u) << "of " << before;
  for (const Witness& witness : swinging.witnesses()) {
    EXPECT_LT(swinging.speedUnder(witness), cutSpeed(swinging.state()));
    EXPECT_LT(Swinging::mostOutside(witness), 0.01 * swinging.state().h * kGravity)
        << "its contact carries it again";
  }
}

TEST_P(TransferredProofs, NothingIsProvedWhereMuchHasChanged) {
  Swinging swinging(GetParam());
  std::vector<BodyId> tops;
  for (int i = 0; i < 8; ++i) {
    tops.push_back(swinging.id("box[" + std::to_string(i) + ",7]"));
  }
  swinging.free(tops);
  EXPECT_TRUE(swinging.collection().certificate.empty());
}

INSTANTIATE_TEST_SUITE_P(Frames, TransferredProofs, testing::Bool(), [](const auto& of) {
  return std::string(of.param ? "floating" : "moved");
});

}  // namespace
}  // namespace merge2d
