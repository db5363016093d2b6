#include "src2d/merging/sweep.h"

#include <algorithm>

#include "src2d/core/memory.h"
#include "src2d/dynamics/nncg.h"
#include "src2d/merging/collection.h"
#include "src2d/merging/disturbance.h"
#include "src2d/merging/joint_sweep.h"
#include "src2d/merging/ordering.h"

namespace merge2d {
namespace {

void sweepBlock(ContactBlock& k, const Rotation& turn, std::vector<SolverVelocity>& u,
                SolverMethod method) {
  const double nx = turn.c * k.nx - turn.s * k.ny, ny = turn.s * k.nx + turn.c * k.ny;
  if (method == SolverMethod::Pgs) {
    solveRows(k, nx, ny, u[k.a], u[k.b]);
  } else {
    solveBlock(k, nx, ny, u[k.a], u[k.b]);
  }
}

/// Contacts and joints in the order of a disturbed step: outside ones and those inside disturbed
/// collections.
struct SweepItem {
  ContactBlock* block;
  JointBlock* joint;  ///< when there is no contact
  Rotation turn;

  std::uint32_t a() const { return block ? block->a : joint->a; }
  std::uint32_t b() const { return block ? block->b : joint->b; }
  Impulses& impulses() const { return block ? block->lambda : joint->lambda; }
};

void sweepItem(const SweepItem& item, std::vector<SolverVelocity>& u, SolverMethod method) {
  if (item.block) return sweepBlock(*item.block, item.turn, u, method);
  solveJoint(*item.joint, item.turn, u[item.joint->a], u[item.joint->b]);
}

std::vector<SweepItem> disturbedOrder(State& state, Scratch& scratch) {
  std::vector<SweepItem> items;
  std::vector<GraphEdge> edges;
  const auto add = [&](const SweepItem& item) {
    items.push_back(item);
    edges.push_back({item.a(), item.b()});
  };
  // Of the contacts outside, those at disturbed collections and the fresh ones between free bodies.
  const auto concerned = [&](std::uint32_t b) {
    if (b >= state.bodies.size()) return true;  // the world
    const RigidId id = state.bodies[b].rigid;
    return !state.isCollection(id) || scratch.disturbed[index(id) - state.bodies.size()];
  };
  for (SweepContact& outer : scratch.sweep_contacts) {
    if (concerned(outer.block.a) && concerned(outer.block.b)) add({&outer.block, nullptr, {}});
  }
  for (JointBlock& k : scratch.sweep_joints) {
    if (concerned(k.a) && concerned(k.b)) add({nullptr, &k, {}});
  }
  for (std::size_t slot = 0; slot < state.collections.size(); ++slot) {
    Collection& c = state.collections[slot];
    if (!scratch.disturbed[slot]) continue;
    const Rotation& turn = state[c.rigid].rotation;
    for (ContactBlock& k : c.blocks) add({&k, nullptr, turn});
    for (JointBlock& k : c.joints) add({nullptr, &k, turn});
  }
  std::vector<std::uint8_t> passable(scratch.sweep_u.size());
  for (std::size_t i = 0; i < passable.size(); ++i) {
    passable[i] = scratch.sweep_u[i].inv_mass > 0.0;
  }
  std::vector<std::uint32_t> depth;
  const auto order = breadthFirst(static_cast<std::uint32_t>(passable.size()), edges, scratch.seeds,
                                  passable, scratch.notes ? &depth : nullptr);
  if (scratch.notes) {
    for (const std::uint32_t i : order) {
      if (std::max(edges[i].a, edges[i].b) >= state.bodies.size()) continue;  // to the world
      scratch.notes->order.push_back(
          {BodyId{edges[i].a}, BodyId{edges[i].b}, static_cast<int>(depth[i])});
    }
  }
  std::vector<SweepItem> ordered;
  ordered.reserve(order.size());
  for (const std::uint32_t i : order) ordered.push_back(items[i]);
  return ordered;
}

/// Sweeps over the active contacts of a collection. What they change is added to each member's
/// push. Returns the largest change of a member's velocity [m/s].
double sweepInside(const State& state, Collection& c, Scratch& scratch, int sweeps) {
  auto& u = scratch.sweep_u;
  auto& before = scratch.sweep_before;
  const std::size_t n = c.members.size();
  reserveTightly(before, n);
  before.resize(std::max(before.size(), n));
  for (std::size_t i = 0; i < n; ++i) {
    const SolverVelocity& m = u[index(c.members[i])];
    before[i] = {m.vx, m.vy, m.omega};
  }
  const Rotation turn = state[c.rigid].rotation;
  for (int s = 0; s < sweeps; ++s) {
    for (JointBlock& k : c.joints) solveJoint(k, turn, u[k.a], u[k.b]);
    for (std::uint32_t i = 0; i < c.active_blocks; ++i) {
      sweepBlock(c.blocks[i], turn, u, state.settings.solver.method);
    }
  }
  const Rotation back = turn.inverse();
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const SolverVelocity& m = u[index(c.members[i])];
    const Vec2 change = back * Vec2(m.vx - before[i].vx, m.vy - before[i].vy);
    c.push[i].vx += change.x();
    c.push[i].vy += change.y();
    c.push[i].omega += m.omega - before[i].omega;
    largest = std::max(largest, change.squaredNorm());
  }
  return std::sqrt(largest);
}

/// A collection that nothing disturbs is swept once; one that could sleep but for its inner forces
/// a few times more, so that it soon can.
void sweepUndisturbed(const State& state, Collection& c, Scratch& scratch) {
  const UnmergingSettings& settings = state.settings.unmerging;
  const bool resting =
      sleeps(state.mode) && state[c.rigid].quiet_steps >= state.settings.sleeping.steps;
  if (resting && !c.settled) sweepInside(state, c, scratch, settings.disturbed_sweeps);
  const double change = sweepInside(state, c, scratch, settings.sweeps);
  c.settled = change <= residualVelocity(state);
}

/// Several sweeps in the order given, accelerated as in the full solve.
void sweepConverging(const State& state, Scratch& scratch, const std::vector<SweepItem>& items) {
  const UnmergingSettings& settings = state.settings.unmerging;
  const SolverMethod method = state.settings.solver.method;
  std::vector<std::uint32_t> bodies;
  for (const SweepItem& item : items) {
    for (const std::uint32_t b : {item.a(), item.b()}) {
      if (scratch.sweep_u[b].inv_mass > 0.0) bodies.push_back(b);
    }
  }
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  Nncg iteration(
      items.size(), [&](std::size_t i) -> Impulses& { return items[i].impulses(); }, bodies.size(),
      [&](std::size_t i) -> SolverVelocity& { return scratch.sweep_u[bodies[i]]; },
      [&] {
        for (const SweepItem& item : items) sweepItem(item, scratch.sweep_u, method);
      },
      scratch.nncg);
  const bool paper = settings.rule == Rule::Paper;
  iteration.run(paper ? settings.sweeps : settings.disturbed_sweeps,
                method == SolverMethod::Nncg && !paper);
}

/// Breadth first from what is new, over contacts inside and outside.
void sweepDisturbed(State& state, Scratch& scratch) {
  sweepConverging(state, scratch, disturbedOrder(state, scratch));
  for (std::size_t slot = 0; slot < state.collections.size(); ++slot) {
    Collection& c = state.collections[slot];
    if (!scratch.disturbed[slot]) continue;
    layOutPush(state, c);
    c.settled = false;
  }
}

/// Between two collections that are fixed to a frame the full solve has no row: what the sweep
/// found there is all that is known.
void keepFixedContacts(State& state, const Scratch& scratch) {
  for (const SweepContact& outer : scratch.sweep_contacts) {
    const ContactBlock& k = outer.block;
    if (state.rigid(BodyId{k.a}).floating() || state.rigid(BodyId{k.b}).floating()) continue;
    Contact& contact = state.contacts.slots[outer.slot];
    for (int i = 0; i < k.count; ++i) {
      ContactPoint& point = contact.points[static_cast<std::size_t>(i)];
      point.lambda_n = k.lambda_n(i);
      point.lambda_t = k.lambda_t(i);
      const ContactVelocity w =
          contactVelocity(k, i, k.nx, k.ny, scratch.sweep_u[k.a], scratch.sweep_u[k.b]);
      point.w_n = static_cast<float>(w.n);
      point.w_t = static_cast<float>(w.t);
    }
  }
}

}  // namespace

bool isSwept(const State& state, const Collection& c) {
  return c.id != kNoCollection && !state[c.rigid].asleep;
}

double residualVelocity(const State& state) {
  constexpr double kPart = 1e-3;
  return std::max(kPart * state.h * state.gravity.norm(), state.settings.sleeping.velocity);
}

void sweepCollections(State& state, Scratch& scratch) {
  if (!scratch.sweeping) return;
  const bool disturbed = std::any_of(scratch.disturbed.begin(), scratch.disturbed.end(),
                                     [](std::uint8_t d) { return d != 0; });
  if (disturbed) {
    spreadDisturbance(state, scratch);
    sweepDisturbed(state, scratch);
  }
  for (JointBlock& k : scratch.sweep_joints) {
    solveJoint(k, {}, scratch.sweep_u[k.a], scratch.sweep_u[k.b]);
  }
  for (SweepContact& outer : scratch.sweep_contacts) {
    sweepBlock(outer.block, {}, scratch.sweep_u, state.settings.solver.method);
  }
  for (std::size_t slot = 0; slot < state.collections.size(); ++slot) {
    Collection& c = state.collections[slot];
    if (isSwept(state, c) && !scratch.disturbed[slot]) sweepUndisturbed(state, c, scratch);
  }
  keepFixedContacts(state, scratch);
  if (!state.joints.empty()) keepJointForces(state, scratch);
}

void sweepAgain(State& state, Scratch& scratch, Collection& c) {
  std::vector<SweepItem> items;
  for (SweepContact& outer : scratch.sweep_contacts) {
    const ContactBlock& k = outer.block;
    const bool at = state.bodies[k.a].rigid == c.rigid || state.bodies[k.b].rigid == c.rigid;
    if (at) items.push_back({&outer.block, nullptr, {}});
  }
  for (JointBlock& k : scratch.sweep_joints) items.push_back({nullptr, &k, {}});
  for (ContactBlock& k : c.blocks) items.push_back({&k, nullptr, state[c.rigid].rotation});
  for (JointBlock& k : c.joints) items.push_back({nullptr, &k, state[c.rigid].rotation});
  sweepConverging(state, scratch, items);
  if (!state.joints.empty()) keepJointForces(state, scratch);
  layOutPush(state, c);
}

}  // namespace merge2d
