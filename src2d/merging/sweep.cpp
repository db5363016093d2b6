#include "src2d/merging/sweep.h"

#include <algorithm>

#include "src2d/dynamics/nncg.h"
#include "src2d/dynamics/solver.h"
#include "src2d/merging/collection.h"
#include "src2d/merging/joint_sweep.h"
#include "src2d/merging/ordering.h"

namespace merge2d {
namespace {

/// A contact that closes slower than this disturbs nobody [m/s].
constexpr double kGentle = 1e-3;

bool isMember(const State& state, BodyId b) { return state.isCollection(state[b].rigid); }

/// How fast a contact closes that was open in the last step and meets in this one [m/s]; 0 for any
/// other.
double closingSpeed(const State& state, const Contact& contact) {
  const Pose pose_a = state.pose(contact.key.a);
  const Rigid &a = state.rigid(contact.key.a), &b = state.rigid(contact.key.b);
  double fastest = 0.0;
  for (int i = 0; i < contact.count; ++i) {
    const ContactPoint& point = contact.points[static_cast<std::size_t>(i)];
    if (!point.fresh) continue;
    const Vec2 p = pose_a * point.position;
    const double w_n = (pose_a.rotation * contact.normal).dot(b.velocityAt(p) - a.velocityAt(p));
    if (w_n + std::max(0.0, point.gap) / state.h >= -kGentle) continue;
    fastest = std::max(fastest, -w_n);
  }
  return fastest;
}

/// A contact that was open in the last step and closes in this one.
bool closesAnew(const State& state, const Contact& contact) {
  return closingSpeed(state, contact) > 0.0;
}

/// Pairs that meet faster than this are an impact: gravity alone does not do it within two steps,
/// so a resting body that lost its contact for a moment is none [m/s].
double impactSpeed(const State& state) {
  return std::max(2.0 * state.h * state.gravity.norm(), state.settings.unmerging.velocity);
}

/// Velocity of a member before the last position update: Deviation from the start with today's
/// velocity, which would miss the force that keeps the member on its circle.
/// Guarded by Sweep.HoldsASpinningMemberOnItsCircle.
void startMembers(const State& state, const Collection& c, Scratch& scratch) {
  const Rigid& r = state[c.rigid];
  const Rotation before = r.previous_rotation;
  for (std::size_t i = 0; i < c.members.size(); ++i) {
    const Body& body = state[c.members[i]];
    const Vec2 arm = before * (body.local - r.center);
    const Twist& push = c.push[i];
    const Vec2 pushed = r.rotation * Vec2(push.vx, push.vy);
    SolverVelocity& u = scratch.sweep_u[index(c.members[i])];
    u.vx = r.v.x() - r.omega * arm.y() + state.h * state.gravity.x() + pushed.x();
    u.vy = r.v.y() + r.omega * arm.x() + state.h * state.gravity.y() + pushed.y();
    u.omega = r.omega + push.omega;
    u.inv_mass = 1.0 / body.mass;
    u.inv_inertia = 1.0 / body.inertia;
  }
}

/// Free bodies, and those that do not respond to forces.
void startOthers(const State& state, Scratch& scratch) {
  for (std::uint32_t i = 0; i < state.bodies.size(); ++i) {
    const BodyId b{i};
    if (isMember(state, b) || !state[b].alive) continue;
    const Rigid& r = state[rigidOf(b)];
    const bool free = r.floating() && !r.asleep;
    SolverVelocity& u = scratch.sweep_u[i];
    u = {r.v.x(), r.v.y(), r.omega, free ? r.inv_mass : 0.0, free ? r.inv_inertia : 0.0};
    if (!free) continue;
    u.vx += state.h * state.gravity.x();
    u.vy += state.h * state.gravity.y();
  }
}

void addLoads(const State& state, Scratch& scratch) {
  for (const Load& load : scratch.loads) {
    SolverVelocity& u = scratch.sweep_u[index(load.body)];
    u.vx += state.h * u.inv_mass * load.force.x();
    u.vy += state.h * u.inv_mass * load.force.y();
    u.omega += state.h * u.inv_inertia * load.torque;
  }
  for (const Kick& kick : scratch.kicks) {
    SolverVelocity& u = scratch.sweep_u[index(kick.body)];
    u.vx += u.inv_mass * kick.impulse.x();
    u.vy += u.inv_mass * kick.impulse.y();
    u.omega += u.inv_inertia * cross(kick.at - state.pose(kick.body).position, kick.impulse);
  }
}

/// The rows of a contact outside collections, with the bodies' own masses.
void addOuterContact(const State& state, const Contact& contact, std::uint32_t slot,
                     Scratch& scratch) {
  const BodyId a = contact.key.a, b = contact.key.b;
  const SolverVelocity &ua = scratch.sweep_u[index(a)], &ub = scratch.sweep_u[index(b)];
  if (ua.inv_mass == 0.0 && ub.inv_mass == 0.0) return;
  const Pose pose_a = state.pose(a);
  const Vec2 x_b = state.pose(b).position;
  const SolverSettings& settings = state.settings.solver;
  BlockGeometry g;
  g.normal = pose_a.rotation * contact.normal;
  g.count = contact.count;
  g.softness = contactSoftness(settings, ua.inv_mass, ub.inv_mass);
  SweepContact outer{.slot = slot, .block = {}};
  ContactBlock& k = outer.block;
  for (int i = 0; i < contact.count; ++i) {
    const ContactPoint& point = contact.points[static_cast<std::size_t>(i)];
    const Vec2 p = pose_a * point.position;
    g.arm_a[i] = p - pose_a.position;
    g.arm_b[i] = p - x_b;
    k.lambda_n(i) = point.lambda_n;
    k.lambda_t(i) = point.lambda_t;
    k.bias[i] = contactBias(settings, state.h, point.gap);
  }
  k.a = static_cast<std::uint32_t>(a);
  k.b = static_cast<std::uint32_t>(b);
  k.mu = frictionOf(state, contact.key.a, contact.key.b);
  k.bilateral = isBilateral(state, a, b);
  prepareBlock(k, g, ua, ub);
  scratch.sweep_contacts.push_back(outer);
}

/// The impulses of the last step, on the velocities.
void applyWarmStart(const ContactBlock& k, std::vector<SolverVelocity>& u) {
  for (int i = 0; i < k.count; ++i) {
    applyImpulse(k, i, k.nx, k.ny, k.lambda_n(i), k.lambda_t(i), u[k.a], u[k.b]);
  }
}

/// The same for a contact that is not swept itself: a load on the bodies around a collection.
void applyAsLoad(const State& state, const Contact& contact, std::vector<SolverVelocity>& u) {
  const Pose pose_a = state.pose(contact.key.a);
  const Vec2 x_b = state.pose(contact.key.b).position;
  const Vec2 n = pose_a.rotation * contact.normal, t = perpendicular(n);
  for (int i = 0; i < contact.count; ++i) {
    const ContactPoint& point = contact.points[static_cast<std::size_t>(i)];
    const Vec2 p = pose_a * point.position, impulse = point.lambda_n * n + point.lambda_t * t;
    const auto push = [&](BodyId b, const Vec2& arm, double sign) {
      SolverVelocity& v = u[index(b)];
      v.vx += sign * v.inv_mass * impulse.x();
      v.vy += sign * v.inv_mass * impulse.y();
      v.omega += sign * v.inv_inertia * cross(arm, impulse);
    };
    push(contact.key.a, p - pose_a.position, -1.0);
    push(contact.key.b, p - x_b, 1.0);
  }
}

/// Contacts at swept collections, and fresh ones, get rows; the others of the free bodies there
/// keep pushing with the impulses of the last step.
void warmStartOuter(const State& state, Scratch& scratch) {
  scratch.sweep_contacts.clear();
  auto& near = scratch.near_collection;
  near.assign(state.bodies.size(), 0);
  const auto swept = [&](BodyId b) { return isMember(state, b) && !state.rigid(b).asleep; };
  const auto forEach = [&](auto&& visit) {
    for (const BodyPair& pair : scratch.pairs) {
      for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
        const ContactTable::Entry& entry = state.contacts.order[i];
        if (state.contacts[entry].count > 0) visit(entry, state.contacts[entry]);
      }
    }
  };
  forEach([&](const ContactTable::Entry& entry, const Contact& contact) {
    const BodyId a = contact.key.a, b = contact.key.b;
    if (!swept(a) && !swept(b) && !closesAnew(state, contact)) return;
    near[index(a)] = near[index(b)] = 1;
    addOuterContact(state, contact, entry.slot, scratch);
  });
  if (!state.joints.empty()) listSweepJoints(state, scratch);
  std::size_t row = 0;
  forEach([&](const ContactTable::Entry& entry, const Contact& contact) {
    const auto& rows = scratch.sweep_contacts;
    if (row < rows.size() && rows[row].slot == entry.slot) return void(++row);
    if (near[index(contact.key.a)] || near[index(contact.key.b)]) {
      applyAsLoad(state, contact, scratch.sweep_u);
    }
  });
  for (const SweepContact& outer : scratch.sweep_contacts) {
    applyWarmStart(outer.block, scratch.sweep_u);
  }
  if (!state.joints.empty()) warmStartSweepJoints(state, scratch);
}

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

}  // namespace

bool isSwept(const State& state, const Collection& c) {
  return c.id != kNoCollection && !state[c.rigid].asleep;
}

/// True when the frame gains another velocity in this step than in the last one, by more than a
/// hundredth of gravity: then one sweep cannot follow the load.
bool frameJumps(const State& state, Collection& c) {
  constexpr double kPart = 1e-2;
  const Rigid& r = state[c.rigid];
  const bool scripted = !r.floating() && r.anchor != kWorldFrame;
  const Vec2 v = scripted ? state[rigidOf(c.anchor)].v : r.v;
  const Vec2 gain = v - c.frame_v;
  const double jump = (gain - c.frame_gain).norm();
  const bool known = c.frame_known >= 2;
  c.frame_v = v;
  c.frame_gain = gain;
  if (!known) ++c.frame_known;
  return known && jump > kPart * state.h * std::max(state.gravity.norm(), 1.0);
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

double residualVelocity(const State& state) {
  constexpr double kPart = 1e-3;
  return std::max(kPart * state.h * state.gravity.norm(), state.settings.sleeping.velocity);
}

/// An event for each pair that touched nowhere in the last step and hits in this one.
void reportImpacts(const State& state, Scratch& scratch) {
  const double threshold = impactSpeed(state);
  for (const BodyPair& pair : scratch.pairs) {
    double fastest = 0.0;
    bool touched = false;
    for (std::uint32_t i = pair.first; i < pair.first + pair.count && !touched; ++i) {
      const Contact& contact = state.contacts[state.contacts.order[i]];
      const auto held = [](const ContactPoint& p) { return !p.fresh; };
      touched = std::any_of(contact.points.begin(), contact.points.begin() + contact.count, held);
      if (!touched) fastest = std::max(fastest, closingSpeed(state, contact));
    }
    if (touched || fastest == 0.0) continue;
    const bool hits = fastest > threshold;
    if (hits) scratch.events.push_back({EventType::Impact, pair.a, pair.b});
    if (!scratch.notes) continue;
    scratch.notes->decisions.push_back({.a = pair.a,
                                        .b = pair.b,
                                        .stage = "ContactOrdering",
                                        .criterion = "impact",
                                        .equation = "Section 6.2",
                                        .value = fastest,
                                        .threshold = threshold,
                                        .verdict = hits ? "impact" : "touch"});
  }
}

void orderContacts(State& state, Scratch& scratch) {
  reportImpacts(state, scratch);
  scratch.seeds.clear();
  scratch.disturbed.assign(state.collections.size(), 0);
  if (!state.settings.unmerging.ordering) return;
  const auto seed = [&](BodyId b) {
    scratch.seeds.push_back(static_cast<std::uint32_t>(b));
    const RigidId id = state[b].rigid;
    if (state.isCollection(id)) {
      scratch.disturbed[index(id) - state.bodies.size()] = 1;
    }
  };
  for (Collection& c : state.collections) {
    if (isSwept(state, c) && frameJumps(state, c)) {
      scratch.disturbed[index(c.rigid) - state.bodies.size()] = 1;
    }
  }
  for (const Kick& kick : scratch.kicks) seed(kick.body);
  for (const BodyId b : scratch.stirred) seed(b);
  for (const BodyPair& pair : scratch.pairs) {
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
      const Contact& contact = state.contacts[state.contacts.order[i]];
      if (!closesAnew(state, contact)) continue;
      seed(pair.a);
      seed(pair.b);
      break;
    }
  }
  if (scratch.notes) {
    for (const std::uint32_t s : scratch.seeds) scratch.notes->seeds.push_back(BodyId{s});
  }
}

/// What a collection feels, those that touch it feel in the same step.
void spreadDisturbance(const State& state, Scratch& scratch) {
  const auto slotOf = [&](std::uint32_t b) -> std::uint8_t* {
    if (b >= state.bodies.size()) return nullptr;  // the world
    const RigidId id = state.bodies[b].rigid;
    return state.isCollection(id) ? &scratch.disturbed[index(id) - state.bodies.size()] : nullptr;
  };
  bool spread = true;
  while (spread) {
    spread = false;
    const auto pass = [&](std::uint32_t body_a, std::uint32_t body_b) {
      std::uint8_t *a = slotOf(body_a), *b = slotOf(body_b);
      if (!a || !b || *a == *b) return;
      *a = *b = 1;
      spread = true;
    };
    for (const SweepContact& outer : scratch.sweep_contacts) pass(outer.block.a, outer.block.b);
    for (const JointBlock& k : scratch.sweep_joints) pass(k.a, k.b);
  }
}

void warmStartSweep(State& state, Scratch& scratch) {
  scratch.sweep_contacts.clear();
  scratch.sweep_joints.clear();
  const bool any = std::any_of(state.collections.begin(), state.collections.end(),
                               [&](const Collection& c) { return isSwept(state, c); });
  scratch.sweeping = any;
  if (!any) return;
  scratch.last_sweep = state.step;
  scratch.sweep_u.resize(state.bodies.size() + 1);  // the world's stands last
  scratch.sweep_u.back() = {};
  startOthers(state, scratch);
  for (const Collection& c : state.collections) {
    if (isSwept(state, c)) startMembers(state, c, scratch);
  }
  addLoads(state, scratch);
  warmStartOuter(state, scratch);
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
