#include "src2d/merging/rigid_parts.h"

#include <algorithm>
#include <limits>

#include "src2d/core/memory.h"
#include "src2d/dynamics/nncg.h"
#include "src2d/merging/momentum.h"
#include "src2d/merging/refine.h"

namespace merge2d {
namespace {

/// More would take too long in passing.
constexpr std::size_t kMostParts = 32, kMostRows = 400;

/// Numbers the parts by their first members; the frame comes after them.
void numberParts(const Collection& c, DisjointSets& sets, RigidParts& p) {
  const auto members = static_cast<std::uint32_t>(c.members.size());
  p.of.resize(members + 1);
  std::uint32_t count = 0;
  for (std::uint32_t m = 0; m < members; ++m) {
    const std::uint32_t first = sets.find(m);
    p.of[m] = first == m ? count++ : p.of[first];
  }
  p.of[members] = count;
}

/// Mass, centre and momentum of each part.
void gatherParts(const State& state, const Scratch& scratch, const Collection& c, RigidParts& p) {
  const Pose frame = state[c.rigid].frame();
  p.parts.assign(p.of.back(), {});
  p.u.assign(p.of.back(), {});
  for (std::size_t m = 0; m < c.members.size(); ++m) {
    const Body& body = state[c.members[m]];
    const SolverVelocity& u = scratch.sweep_u[index(c.members[m])];
    RigidParts::Part& part = p.parts[p.of[m]];
    part.mass += body.mass;
    part.x += body.mass * (frame * body.local);
    part.bounds.include(
        placed(Pose{body.local, body.local_rotation}, state.extent(rigidOf(c.members[m])).bounds));
    p.u[p.of[m]].vx += body.mass * u.vx;
    p.u[p.of[m]].vy += body.mass * u.vy;
  }
  for (RigidParts::Part& part : p.parts) part.x /= part.mass;
  for (std::size_t m = 0; m < c.members.size(); ++m) {
    const Body& body = state[c.members[m]];
    const SolverVelocity& u = scratch.sweep_u[index(c.members[m])];
    RigidParts::Part& part = p.parts[p.of[m]];
    const Vec2 arm = frame * body.local - part.x;
    part.inertia += body.inertia + body.mass * arm.squaredNorm();
    p.u[p.of[m]].omega += body.inertia * u.omega + body.mass * cross(arm, Vec2(u.vx, u.vy));
  }
  for (std::size_t i = 0; i < p.parts.size(); ++i) {
    SolverVelocity& u = p.u[i];
    u.inv_mass = 1.0 / p.parts[i].mass;
    u.inv_inertia = 1.0 / p.parts[i].inertia;
    u = {u.vx * u.inv_mass, u.vy * u.inv_mass, u.omega * u.inv_inertia, u.inv_mass, u.inv_inertia};
  }
}

/// How a single body moves in this step, or the frame.
VelocityField fieldAt(const State& state, const Scratch& scratch, BodyId b) {
  const SolverVelocity& u = scratch.sweep_u[index(b)];
  return {state.pose(b).position, {u.vx, u.vy}, u.omega};
}

/// How a collection moves in this step: with its frame, where it does not float.
VelocityField fieldOfWhole(const State& state, const Scratch& scratch, const Collection& c) {
  return state[c.rigid].floating() ? sweptField(state, scratch, c)
                                   : fieldAt(state, scratch, c.anchor);
}

/// Something beside the parts, as a further one. Returns its number.
std::uint32_t addOutside(RigidParts& p, RigidId id, const VelocityField& field, double inv_mass,
                         double inv_inertia) {
  p.parts.emplace_back().x = field.x;
  p.outside.push_back(id);
  p.u.push_back({field.v.x(), field.v.y(), field.omega, inv_mass, inv_inertia});
  return static_cast<std::uint32_t>(p.u.size() - 1);
}

/// True when a thing moves against the collection by no more than a sweep may leave.
bool restsOn(const State& state, RigidId id, const VelocityField& field, const Collection& c,
             const VelocityField& whole) {
  double speed = std::numeric_limits<double>::infinity();
  for (const RigidId i : {id, c.rigid}) {
    OrientedBox box = state.extent(i).box;
    box.frame = state[i].frame() * box.frame;
    speed = std::min(speed, fastestCorner(box, field, whole));
  }
  return speed <= residualVelocity(state);
}

/// A body outside that rests on the collection, or on which it rests, may bear any load, and is
/// taken not to respond. One that moves against it only pushes, with no more than its own mass; it
/// clamps nothing.
std::uint32_t outsidePart(const State& state, const Scratch& scratch, const Collection& c,
                          RigidParts& p, BodyId b, const VelocityField& whole) {
  const RigidId id = state[b].rigid;
  const auto known = std::ranges::find(p.outside, id);
  if (known != p.outside.end()) {
    return p.of.back() + static_cast<std::uint32_t>(known - p.outside.begin());
  }
  const Rigid& r = state[id];
  const VelocityField field = state.isCollection(id)
                                  ? fieldOfWhole(state, scratch, state.collection(id))
                                  : fieldAt(state, scratch, b);
  const bool rests = restsOn(state, id, field, c, whole);
  const std::uint32_t part =
      addOutside(p, id, field, rests ? 0.0 : r.inv_mass, rests ? 0.0 : r.inv_inertia);
  p.u[part].surface = state[b].surface_velocity;  // a body with a belt is no member of a collection
  return part;
}

/// One contact as it acts on the parts `a` and `b`; `model` has all that does not depend on them.
void addRow(RigidParts& p, const ContactBlock& model, BlockGeometry& g,
            const std::array<Vec2, 2>& points, std::uint32_t a, std::uint32_t b) {
  g.count = model.count;
  g.softness = model.softness;
  for (std::size_t i = 0; i < static_cast<std::size_t>(model.count); ++i) {
    g.arm_a[i] = points[i] - p.parts[a].x;
    g.arm_b[i] = points[i] - p.parts[b].x;
  }
  ContactBlock& k = p.rows.emplace_back();
  k.a = a;
  k.b = b;
  k.mu = model.mu;
  k.bilateral = model.bilateral;
  k.lambda = model.lambda;
  std::ranges::copy(model.bias, k.bias);
  prepareBlock(k, g, p.u[a], p.u[b]);
}

/// False when there are too many.
bool listWelds(const State& state, const Collection& c, RigidParts& p) {
  const auto isBetween = [&](const Weld& weld) { return p.of[weld.node_a] != p.of[weld.node_b]; };
  std::size_t rows = 0;
  for (const Weld& weld : c.welds) rows += isBetween(weld) ? weld.count : 0;
  if (rows > kMostRows) return false;
  reserveTightly(p.rows, rows);
  reserveTightly(p.weld_of, rows);
  const Pose frame = state[c.rigid].frame();
  const auto partOf = [&](std::uint32_t b) {
    const bool member = state.bodies[b].rigid == c.rigid;
    return member ? p.of[state[rigidOf(BodyId{b})].member] : p.of.back();
  };
  for (std::uint32_t w = 0; w < c.welds.size(); ++w) {
    const Weld& weld = c.welds[w];
    if (!isBetween(weld)) continue;
    for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
      const ContactBlock& inner = c.blocks[c.contacts[i].block];
      BlockGeometry g;
      g.normal = frame.rotation * Vec2(inner.nx, inner.ny);
      const auto& points = c.contacts[i].points;
      addRow(p, inner, g, {frame * points[0].position, frame * points[1].position}, partOf(inner.a),
             partOf(inner.b));
      p.weld_of.push_back(w);
    }
  }
  return true;
}

/// Lists the contacts with bodies outside that lean on members, or they on those. False when there
/// are too many.
bool listOuterContacts(const State& state, const Scratch& scratch, const Collection& c,
                       RigidParts& p) {
  const VelocityField whole = fieldOfWhole(state, scratch, c);
  for (const SweepContact& outer : scratch.sweep_contacts) {
    const Contact& contact = state.contacts.slots[outer.slot];
    const auto [a, b] = std::pair(contact.key.a, contact.key.b);
    const bool a_in = state[a].rigid == c.rigid, b_in = state[b].rigid == c.rigid;
    if (a_in == b_in) continue;
    if (p.rows.size() == kMostRows) return false;
    const std::uint32_t other = outsidePart(state, scratch, c, p, a_in ? b : a, whole);
    const std::uint32_t part = p.of[state[rigidOf(a_in ? a : b)].member];
    const Pose pose = state.pose(a);
    BlockGeometry g;
    g.normal = Vec2(outer.block.nx, outer.block.ny);
    addRow(p, outer.block, g,
           {pose * contact.points[0].position, pose * contact.points[1].position},
           a_in ? part : other, a_in ? other : part);
  }
  return true;
}

/// How fast the parts of a row move against each other: the fastest corner of the one that moves
/// less, as a brick that rocks on a long platform is not far from any of its own corners [m/s].
double speedAt(const State& state, const Collection& c, const RigidParts& p,
               const ContactBlock& row) {
  const Pose frame = state[c.rigid].frame();
  const auto field = [&](std::uint32_t i) {
    return VelocityField{p.parts[i].x, {p.u[i].vx, p.u[i].vy}, p.u[i].omega};
  };
  double speed = std::numeric_limits<double>::infinity();
  for (const std::uint32_t i : {row.a, row.b}) {
    if (p.u[i].inv_mass == 0.0) continue;
    const Aabb& bounds = p.parts[i].bounds;
    const OrientedBox box{frame * Pose{bounds.center(), {}}, 0.5 * bounds.extent()};
    speed = std::min(speed, fastestCorner(box, field(row.a), field(row.b)));
  }
  return speed;
}

double fastestAtWelds(const State& state, const Collection& c, const RigidParts& p) {
  double fastest = 0.0;
  for (std::size_t i = 0; i < p.weld_of.size(); ++i) {
    fastest = std::max(fastest, speedAt(state, c, p, p.rows[i]));
  }
  return fastest;
}

}  // namespace

bool makeParts(const State& state, Scratch& scratch, const Collection& c) {
  RigidParts& p = scratch.rigid_parts;
  numberParts(c, scratch.sets, p);
  if (p.of.back() > kMostParts) return false;
  gatherParts(state, scratch, c, p);
  p.outside.clear();
  if (!state[c.rigid].floating()) {
    addOutside(p, state[c.anchor].rigid, fieldAt(state, scratch, c.anchor), 0.0, 0.0);
  }
  p.rows.clear();
  p.weld_of.clear();
  return listWelds(state, c, p) && listOuterContacts(state, scratch, c, p);
}

double settleParts(const State& state, Scratch& scratch, const Collection& c, double enough) {
  constexpr int kMost = 400, kRound = 50, kFirst = 5;  // sweeps
  constexpr double kSame = 0.01;                       // of the speed
  RigidParts& p = scratch.rigid_parts;
  const SolverMethod method = state.settings.solver.method;
  double before = 0.0;
  for (int done = 0; done < kMost;) {
    const int sweeps = done == 0 ? kFirst : kRound;  // most stay at once
    Nncg iteration(
        p.rows.size(), [&](std::size_t i) -> Impulses& { return p.rows[i].lambda; }, p.u.size(),
        [&](std::size_t i) -> SolverVelocity& { return p.u[i]; },
        [&] {
          for (ContactBlock& k : p.rows) sweepBlock(k, Rotation{}, p.u, method);
        },
        p.nncg);
    iteration.run(sweeps, isAccelerated(method));
    done += sweeps;
    const double fastest = fastestAtWelds(state, c, p);
    const double change = std::abs(fastest - before);
    const bool settled = done > kRound && change < kSame * fastest &&
                         fastest - change * kMost / kRound > enough;  // also if it goes on so
    if (fastest <= enough || settled) return fastest;
    before = fastest;
  }
  return 0.0;
}

std::vector<std::uint32_t> weldsFasterThan(const State& state, const Scratch& scratch,
                                           const Collection& c, double speed) {
  const RigidParts& p = scratch.rigid_parts;
  std::vector<std::uint32_t> welds;
  for (std::size_t i = 0; i < p.weld_of.size(); ++i) {
    const bool known = !welds.empty() && welds.back() == p.weld_of[i];
    if (!known && speedAt(state, c, p, p.rows[i]) > speed) welds.push_back(p.weld_of[i]);
  }
  return welds;
}

}  // namespace merge2d
