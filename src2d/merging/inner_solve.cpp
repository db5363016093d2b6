#include "src2d/merging/inner_solve.h"

#include <algorithm>
#include <cmath>

#include "src2d/dynamics/nncg.h"
#include "src2d/merging/collection.h"
#include "src2d/merging/joint_system.h"
#include "src2d/merging/load_certificate.h"
#include "src2d/merging/refine.h"
#include "src2d/merging/sweep.h"

namespace merge2d {

double cutSpeed(const State& state) { return kDecided.cut_acceleration * state.h; }

namespace {

double toleratedResidual(const State& state) { return kDecided.tolerance * cutSpeed(state); }

/// The change that one more solve of its rows would make, as a velocity [m/s].
double residualOf(const ContactBlock& k, const Vec2& n, const std::vector<SolverVelocity>& u) {
  double most = 0.0;
  for (int i = 0; i < k.count; ++i) {
    const ContactVelocity w = contactVelocity(k, i, n.x(), n.y(), u[k.a], u[k.b]);
    const double kn = i == 0 ? k.k11 : k.k22;
    double x = k.lambda_n(i) - (w.n + k.bias[i] + k.softness * k.lambda_n(i)) / kn;
    if (!k.bilateral) x = std::max(0.0, x);
    const double y = solveTangent(k, i, w.t);
    most = std::max(
        {most, std::abs(x - k.lambda_n(i)) * kn, std::abs(y - k.lambda_t(i)) / k.inv_kt[i]});
  }
  return most;
}

/// Sweeps that a step may spend on so many rows.
int sweepsFor(std::size_t rows) {
  const double most = kDecided.row_sweeps / static_cast<double>(std::max<std::size_t>(rows, 1));
  return static_cast<int>(std::clamp<double>(most, kDecided.least_sweeps, kDecided.most_sweeps));
}

/// Doubted collections that act on each other, and all rows at them.
struct InnerSystem {
  std::vector<std::uint32_t> slots;
  std::vector<SweepItem> items;
  std::vector<std::uint32_t> bodies;

  double residual(const std::vector<SolverVelocity>& u) const {
    double most = 0.0;
    for (const SweepItem& item : items) {
      if (item.block) most = std::max(most, residualOf(*item.block, item.normal(), u));
    }
    return most;
  }
};

/// Finds the systems of a step.
class InnerSystems {
 public:
  InnerSystems(State& state, Scratch& scratch) : state_(state), scratch_(scratch) {
    nodes_ = static_cast<std::uint32_t>(state.collections.size() + state.bodies.size());
    unite();
    number_.assign(nodes_, kNone);
    for (std::uint32_t slot = 0; slot < state.collections.size(); ++slot) addCollection(slot);
    listed_.assign(state.bodies.size(), 0);
    forEachOuter([&](const SweepItem& item) { addOuter(item); });
  }

  std::vector<InnerSystem> systems;

 private:
  static constexpr std::uint32_t kNone = ~0u;

  /// A doubted collection's slot; a free body after all slots; or kNone.
  std::uint32_t nodeOf(std::uint32_t body) const {
    if (body >= state_.bodies.size()) return kNone;  // the world
    const RigidId id = state_.bodies[body].rigid;
    const auto slots = static_cast<std::uint32_t>(state_.collections.size());
    if (!state_.isCollection(id)) {
      return scratch_.sweep_u[body].inv_mass > 0.0 ? slots + body : kNone;
    }
    const bool doubted = doubtOf(state_, scratch_, state_.collection(id)) == Doubt::Load;
    return doubted ? static_cast<std::uint32_t>(index(id) - state_.bodies.size()) : kNone;
  }

  template <class Visit>
  void forEachOuter(Visit&& visit) {
    for (SweepContact& outer : scratch_.sweep_contacts) visit(SweepItem(outer.block));
    for (JointBlock& k : scratch_.sweep_joints) visit(SweepItem(k));
  }

  void unite() {
    sets_.reset(nodes_);
    forEachOuter([&](const SweepItem& item) {
      const std::uint32_t a = nodeOf(item.a()), b = nodeOf(item.b());
      if (a != kNone && b != kNone) sets_.unite(a, b);
    });
  }

  void addCollection(std::uint32_t slot) {
    Collection& c = state_.collections[slot];
    if (doubtOf(state_, scratch_, c) != Doubt::Load) return;
    std::uint32_t& number = number_[sets_.find(slot)];
    if (number == kNone) {
      number = static_cast<std::uint32_t>(systems.size());
      systems.emplace_back();
    }
    InnerSystem& s = systems[number];
    s.slots.push_back(slot);
    const Rotation turn = state_[c.rigid].rotation;
    for (JointBlock& k : c.joints) s.items.emplace_back(k, turn);
    for (ContactBlock& k : c.blocks) s.items.emplace_back(k, turn);
    for (const BodyId b : c.members) s.bodies.push_back(static_cast<std::uint32_t>(b));
  }

  void addOuter(const SweepItem& item) {
    const std::uint32_t a = nodeOf(item.a()), node = a != kNone ? a : nodeOf(item.b());
    if (node == kNone) return;
    const std::uint32_t number = number_[sets_.find(node)];
    if (number == kNone) return;
    systems[number].items.push_back(item);
    for (const std::uint32_t body : {item.a(), item.b()}) {
      const std::uint32_t at = nodeOf(body);
      if (at == kNone || at < state_.collections.size() || listed_[body]) continue;
      listed_[body] = 1;
      systems[number].bodies.push_back(body);
    }
  }

  State& state_;
  Scratch& scratch_;
  std::uint32_t nodes_ = 0;
  DisjointSets sets_;
  std::vector<std::uint32_t> number_;  ///< per node that stands for its set: the system
  std::vector<std::uint8_t> listed_;   ///< per body
};

/// Some sweeps take long to check: a look every few is enough.
constexpr int kLookEvery = 5;

void solve(State& state, Scratch& scratch, InnerSystem& s) {
  auto& u = scratch.sweep_u;
  const double tolerance = toleratedResidual(state);
  const SolverMethod method = state.settings.solver.method;
  int done = 0;
  const auto enough = [&] { return ++done % kLookEvery == 0 && s.residual(u) <= tolerance; };
  Nncg iteration(
      s.items.size(), [&](std::size_t i) -> Impulses& { return s.items[i].impulses(); },
      s.bodies.size(), [&](std::size_t i) -> SolverVelocity& { return u[s.bodies[i]]; },
      [&] {
        for (const SweepItem& item : s.items) sweepItem(item, u, method);
      },
      scratch.nncg);
  iteration.run(sweepsFor(s.items.size()), true, enough);
  for (const std::uint32_t slot : s.slots) {
    settleJoints(state, state.collections[slot], u, tolerance);
  }
  const double left = s.residual(u);
  for (const std::uint32_t slot : s.slots) {
    Collection& c = state.collections[slot];
    c.residual = static_cast<float>(left);
    c.certificate.front().in_doubt = left > tolerance;
    c.certificate.front().push_stale = true;
  }
}

}  // namespace

void solveDoubted(State& state, Scratch& scratch) {
  InnerSystems found(state, scratch);
  for (InnerSystem& system : found.systems) solve(state, scratch, system);
}

namespace {

/// The members' velocities under the load and the impulses of the blocks, in the frame at rest.
void startAtRest(const State& state, Scratch& scratch, Collection& c, const Witness& load) {
  layOutPush(state, c);
  auto& u = scratch.trial_u;
  u.resize(state.bodies.size() + 1);
  for (const Weld& weld : c.welds) u[index(weld.a)] = u[index(weld.b)] = {};
  for (const JointBlock& k : c.joints) u[k.a] = u[k.b] = {};
  for (std::uint32_t m = 0; m < c.members.size(); ++m) {
    if (m == c.certificate.front().heaviest) continue;
    const Body& body = state[c.members[m]];
    const Twist d = loadOnMember(state, c, load, m);
    u[index(c.members[m])] = {d.vx + c.push[m].vx, d.vy + c.push[m].vy, d.omega + c.push[m].omega,
                              1.0 / body.mass, 1.0 / body.inertia};
  }
}

/// Nothing moves against anything else.
bool isAtRest(const Collection& c, const std::vector<SolverVelocity>& u, double speed) {
  return std::ranges::all_of(c.blocks, [&](const ContactBlock& k) {
    for (int p = 0; p < k.count; ++p) {
      const ContactVelocity w = contactVelocity(k, p, k.nx, k.ny, u[k.a], u[k.b]);
      if (std::abs(w.n) > speed || std::abs(w.t) > speed) return false;
    }
    return true;
  });
}

}  // namespace

bool carries(const State& state, Scratch& scratch, Collection& c, const Witness& load) {
  startAtRest(state, scratch, c, load);
  auto& u = scratch.trial_u;
  const double tolerance = toleratedResidual(state);
  const SolverMethod method = state.settings.solver.method;
  const auto residual = [&] {
    double most = 0.0;
    for (const ContactBlock& k : c.blocks) {
      most = std::max(most, residualOf(k, {k.nx, k.ny}, u));
    }
    return most;
  };
  int done = 0;
  const auto enough = [&] { return ++done % kLookEvery == 0 && residual() <= tolerance; };
  Nncg iteration(
      c.blocks.size(), [&](std::size_t i) -> Impulses& { return c.blocks[i].lambda; },
      c.members.size(), [&](std::size_t i) -> SolverVelocity& { return u[index(c.members[i])]; },
      [&] {
        for (JointBlock& k : c.joints) solveJoint(k, {}, u[k.a], u[k.b]);
        for (ContactBlock& k : c.blocks) sweepBlock(k, Vec2(k.nx, k.ny), u, method);
      },
      scratch.nncg);
  iteration.run(sweepsFor(c.blocks.size()), c.joints.empty(), enough);
  return residual() <= tolerance && isAtRest(c, u, cutSpeed(state));
}

}  // namespace merge2d
