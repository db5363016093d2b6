/// The rows of the full solve: from contacts to blocks, grouped by island.

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>
#include <utility>

#include "src2d/contact/approach.h"
#include "src2d/contact/cast.h"
#include "src2d/core/memory.h"
#include "src2d/dynamics/hit_rows.h"
#include "src2d/dynamics/joint_rows.h"
#include "src2d/dynamics/solver.h"
#include "src2d/dynamics/task_pool.h"
#include "src2d/scene/compliance.h"

namespace merge2d {
namespace {

bool simulated(const Rigid& r) { return r.present() && !r.asleep && r.floating(); }

/// The scripted body that a collection is welded to: it has this step's velocity already.
const Rigid& anchorOf(const State& state, std::size_t i) {
  return state[rigidOf(state.collections[i - state.bodies.size()].anchor)];
}

/// u₋ + h M⁻¹ f for everything in B; what is fixed or asleep keeps its velocity.
void startVelocities(const State& state, Scratch& scratch) {
  reserveTightly(scratch.u, state.rigids.size() + 1);
  scratch.u.resize(state.rigids.size() + 1);
  scratch.u.back() = {};
  for (const RigidId id : state.present) {
    const std::size_t i = index(id);
    const bool anchored = state.isCollection(id) && !state.rigids[i].floating() &&
                          state.rigids[i].anchor != kWorldFrame;
    const Rigid& r = anchored ? anchorOf(state, i) : state.rigids[i];
    SolverVelocity& u = scratch.u[i];
    const bool free = simulated(r);
    u = {r.v.x(), r.v.y(), r.omega, free ? r.inv_mass : 0.0, free ? r.inv_inertia : 0.0};
    if (!state.isCollection(id)) u.surface = state.bodies[i].surface_velocity;
  }
  if (!state.joints.empty()) slowTautLinks(state, scratch);
  for (const RigidId id : state.present) {
    SolverVelocity& u = scratch.u[index(id)];
    if (u.inv_mass == 0.0) continue;
    const Rigid& r = state[id];
    const double share = u.inv_mass == r.inv_mass ? 1.0 : r.mass * u.inv_mass;
    u.vx += share * state.h * state.gravity.x();
    u.vy += share * state.h * state.gravity.y();
  }
  for (const BodyId b : scratch.open_members) {
    const Rigid& r = state[rigidOf(b)];
    scratch.u[index(b)] = {r.v.x() + state.h * state.gravity.x(),
                           r.v.y() + state.h * state.gravity.y(), r.omega, 1.0 / state[b].mass,
                           1.0 / state[b].inertia};
  }
  for (const Load& load : scratch.loads) {
    const RigidId mover = moverOf(state, scratch, load.body);
    const Rigid& r = state[mover];
    SolverVelocity& u = scratch.u[index(mover)];
    const double torque = load.torque + cross(state.pose(load.body).position - r.x, load.force);
    u.vx += state.h * u.inv_mass * load.force.x();
    u.vy += state.h * u.inv_mass * load.force.y();
    u.omega += state.h * u.inv_inertia * torque;
  }
  for (const Kick& kick : scratch.kicks) {
    const RigidId mover = moverOf(state, scratch, kick.body);
    const Rigid& r = state[mover];
    SolverVelocity& u = scratch.u[index(mover)];
    u.vx += u.inv_mass * kick.impulse.x();
    u.vy += u.inv_mass * kick.impulse.y();
    u.omega += u.inv_inertia * cross(kick.at - r.x, kick.impulse);
  }
}

/// Of the body itself, also inside a collection: what a contact yields must not change when one of
/// its bodies merges, or each merge would set everything around it in motion.
double ownInverseMass(const State& state, BodyId b) {
  return state.responds(b) ? 1.0 / state[b].mass : 0.0;
}

double ownSoftness(const State& state, BodyId a, BodyId b) {
  return contactSoftness(state, a, b, ownInverseMass(state, a), ownInverseMass(state, b));
}

/// The most that a contact of a block may yield per impulse, lest a blow goes in deeper in this
/// step than contacts are looked for: a bullet would come out on the other side of a plate. A blow
/// of the speed s takes an impulse of m s.
double mostUnderABlow(const State& state, const Scratch& scratch, const ContactKey& key,
                      const ContactBlock& k) {
  const SolverVelocity &a = scratch.u[k.a], &b = scratch.u[k.b];
  double speed = 0.0;
  for (int i = 0; i < k.count; ++i) {
    speed = std::max(speed, -contactVelocity(k, i, k.nx, k.ny, a, b).n);
  }
  const double inv_mass = ownInverseMass(state, key.a) + ownInverseMass(state, key.b);
  constexpr double kNoBlow = std::numeric_limits<double>::infinity();
  return speed > 0.0 ? state.settings.solver.margin * inv_mass / (state.h * speed) : kNoBlow;
}

/// Sets the bias of a point, or leaves it to the hits. True when it rests.
bool aimRow(const State& state, const Scratch& scratch, const Contact& contact, ContactPoint& point,
            ContactBlock& k, int i, const Cast* cast) {
  point.struck = 0.0F;
  const CastEnd* end = cast ? castOf(scratch, contact, point) : nullptr;
  const double gap = end ? end->carried : point.gap;
  k.bias[i] = contactBias(state.settings.solver, state.h, gap, k.bilateral);
  const bool elastic = restitutionOf(state, contact.key.a, contact.key.b) > 0.0;
  if (elastic || end) {
    const auto velocity = [&](const SolverVelocity& a, const SolverVelocity& b) {
      return contactVelocity(k, i, k.nx, k.ny, a, b).n;
    };
    const double w_free = velocity(scratch.u[k.a], scratch.u[k.b]);
    const double w_start =
        velocity(velocityAtStart(state, scratch, k.a), velocityAtStart(state, scratch, k.b));
    if (isHit(state, contact, cast, gap, w_start, w_free)) {
      k.bias[i] = kNeverActs;
      k.hits = static_cast<std::uint8_t>(k.hits | 1U << i);
      k.lambda_n(i) = k.lambda_t(i) = 0.0;
      return false;
    }
    // A body that has bounced leaves an overlap by itself: help would add energy.
    if (elastic && point.lambda_n == 0.0) k.bias[i] = std::max(k.bias[i], -std::max(0.0, w_free));
  }
  return k.bilateral || gap <= 0.0;
}

/// The points of one pair of bodies, two to a block where they share a normal.
void listSources(const State& state, const BodyPair& pair, Scratch& scratch) {
  const RigidId a = moverOf(state, scratch, pair.a), b = moverOf(state, scratch, pair.b);
  if (scratch.u[index(a)].inv_mass == 0.0 && scratch.u[index(b)].inv_mass == 0.0) return;
  auto& sources = scratch.row_sources;
  const std::size_t first = sources.size();
  for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
    const ContactTable::Slot slot = state.contacts.order[i];
    const Contact& contact = state.contacts[slot];
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(contact.count); ++k) {
      const PointIndex point = 2 * slot + k;
      const bool joins =
          sources.size() > first && sources.back().count() == 1 &&
          state.contacts.contactOf(sources.back().points[0]).normal == contact.normal;
      if (joins) {
        sources.back().points[1] = point;
      } else {
        sources.push_back({{point, RowSource::kNone}});
      }
    }
  }
}

/// The contacts inside the collections that are open.
void listInnerSources(const State& state, Scratch& scratch) {
  if (scratch.open.empty()) return;
  for (std::uint32_t slot = 0; slot < state.collections.size(); ++slot) {
    const Collection& c = state.collections[slot];
    if (c.id == kNoCollection || !scratch.open[index(c.members.front())]) continue;
    for (std::uint32_t block = 0; block < c.blocks.size(); ++block) {
      scratch.row_sources.push_back(RowSource::inside(slot, block));
    }
  }
}

struct RowEnds {
  RigidId a{}, b{};
};
RowEnds endsOf(const State& state, const Scratch& scratch, const RowSource& source) {
  if (source.isInner()) {
    const ContactBlock& k = state.collections[source.slot()].blocks[source.block()];
    return {RigidId{k.a}, RigidId{k.b}};
  }
  const ContactKey& key = state.contacts.contactOf(source.points[0]).key;
  return {moverOf(state, scratch, key.a), moverOf(state, scratch, key.b)};
}

/// A block of a collection, turned into the world.
ContactBlock innerBlock(const State& state, const RowSource& source) {
  const Collection& c = state.collections[source.slot()];
  ContactBlock k = c.blocks[source.block()];
  const Vec2 n = state[c.rigid].rotation * Vec2(k.nx, k.ny);
  k.nx = n.x();
  k.ny = n.y();
  return k;
}

/// Takes back the notes of the last step about the bodies of its islands, and about no others.
void clearMarks(Scratch& scratch) {
  const auto clear = [&](std::uint32_t r) {
    if (r < scratch.colours.size()) scratch.colours[r] = 0;
    if (r < scratch.island_of.size()) scratch.island_of[r] = -1;
  };
  for (const Island& island : scratch.islands) clear(island.root);
  for (const std::uint32_t r : scratch.island_bodies) clear(r);
}

/// Sorts the blocks by island, then by colour, then by source, in which order they come: each pass
/// counts, and keeps the order of the one before.
void sortBlocks(Scratch& scratch) {
  auto& order = scratch.block_order;
  thread_local std::vector<BlockOrder> by_colour;  // its memory serves all worlds of the thread
  std::array<std::uint32_t, 65> place{};           // of the next block of each colour
  for (const BlockOrder& block : order) ++place[block.colour() + 1];
  std::partial_sum(place.begin(), place.end(), place.begin());
  by_colour.resize(order.size());
  for (const BlockOrder& block : order) by_colour[place[block.colour()]++] = block;

  auto& next = scratch.island_of;  // per root: first how many blocks, then where the next one goes
  auto& roots = scratch.island_roots;
  roots.clear();
  for (const BlockOrder& block : order) {
    if (next[block.island()] < 0) roots.push_back(block.island());
    next[block.island()] = std::max(next[block.island()], 0) + 1;
  }
  std::ranges::sort(roots);
  std::int32_t first = 0;
  for (const std::uint32_t root : roots) first += std::exchange(next[root], first);
  for (const BlockOrder& block : by_colour) {
    order[static_cast<std::size_t>(next[block.island()]++)] = block;
  }
}

/// Orders the blocks by island and, inside it, by colour: blocks of one colour share no body, so
/// that consecutive ones need not wait for each other's results.
void orderBlocks(const State& state, Scratch& scratch) {
  clearMarks(scratch);
  auto& sets = scratch.sets;
  sets.reset(state.rigids.size());
  const auto moves = [&](RigidId id) { return scratch.u[index(id)].inv_mass > 0.0; };
  for (const RowSource& source : scratch.row_sources) {
    const auto [a, b] = endsOf(state, scratch, source);
    if (moves(a) && moves(b)) {
      sets.unite(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
    }
  }
  uniteJoints(state, scratch);
  // Greedy colours, in the order of the pairs.
  resizeTightly(scratch.colours, state.rigids.size());
  resizeTightly(scratch.island_of, state.rigids.size(), -1);
  reserveTightly(scratch.block_order, scratch.row_sources.size());
  scratch.block_order.resize(scratch.row_sources.size());
  for (std::uint32_t i = 0; i < scratch.row_sources.size(); ++i) {
    const RowEnds ends = endsOf(state, scratch, scratch.row_sources[i]);
    const bool a_moves = moves(ends.a), b_moves = moves(ends.b);
    std::uint64_t &a = scratch.colours[index(ends.a)], &b = scratch.colours[index(ends.b)];
    const std::uint64_t used = (a_moves ? a : 0) | (b_moves ? b : 0);
    const auto colour = static_cast<std::uint32_t>(std::min(std::countr_one(used), 63));
    if (a_moves) a |= std::uint64_t{1} << colour;
    if (b_moves) b |= std::uint64_t{1} << colour;
    const auto body = static_cast<std::uint32_t>(a_moves ? ends.a : ends.b);
    scratch.block_order[i] = BlockOrder::of(sets.find(body), colour, i);
  }
  sortBlocks(scratch);
}

/// Lever arms of the points of a block: as they are now, or as they will be where it was `cast` to.
void setArms(const State& state, const Scratch& scratch, const RowSource& source, const Cast* cast,
             const ContactBlock& k, BlockGeometry& g) {
  const Contact& contact = state.contacts.contactOf(source.points[0]);
  const Pose pose_a = state.pose(contact.key.a);
  const Vec2 &center_a = state.rigids[k.a].x, &center_b = state.rigids[k.b].x;
  for (std::size_t i = 0; i < static_cast<std::size_t>(source.count()); ++i) {
    const ContactPoint& point = state.contacts.point(source.points[i]);
    const CastEnd* end = nullptr;
    if (cast) end = castOf(scratch, state.contacts.contactOf(source.points[i]), point);
    const Vec2 p = pose_a * point.position;
    g.arm_a[i] = p - center_a;
    g.arm_b[i] = (end ? state.pose(contact.key.b) * end->on_b : p) - center_b;
  }
}

/// Fills the rows of a block but for their effective masses, with the impulses of the last step as
/// a start. True when some of it rests.
bool aimBlock(State& state, const Scratch& scratch, const RowSource& source, const Cast* cast,
              BlockGeometry& g, ContactBlock& k) {
  setArms(state, scratch, source, cast, k, g);
  setArms(k, g);
  bool rests = false;
  for (int i = 0; i < source.count(); ++i) {
    const PointIndex place = source.points[static_cast<std::size_t>(i)];
    ContactPoint& point = state.contacts.point(place);
    k.lambda_n(i) = point.lambda_n;
    k.lambda_t(i) = point.lambda_t;
    rests |= aimRow(state, scratch, state.contacts.contactOf(place), point, k, i, cast);
  }
  return rests;
}

/// The rows of one block.
ContactBlock makeBlock(State& state, const Scratch& scratch, const RowSource& source) {
  if (source.isInner()) return innerBlock(state, source);
  const Contact& contact = state.contacts.contactOf(source.points[0]);
  const RowEnds ends = endsOf(state, scratch, source);
  BlockGeometry g;
  g.normal = state.pose(contact.key.a).rotation * contact.normal;
  g.count = source.count();
  ContactBlock k;
  k.a = static_cast<std::uint32_t>(ends.a);
  k.b = static_cast<std::uint32_t>(ends.b);
  k.mu = frictionOf(state, contact.key.a, contact.key.b);
  k.bilateral = isBilateral(state, contact.key.a, contact.key.b);
  const Cast* cast = scratch.casts.empty() ? nullptr : castToHit(state, scratch, contact);
  bool rests = aimBlock(state, scratch, source, cast, g, k);
  if (cast && k.hits == 0) rests = aimBlock(state, scratch, source, nullptr, g, k);
  if (source.count() == 1 && k.hits == 0) {
    k.setRolling(rollingOf(state, contact.key.a, contact.key.b), rollingImpulse(state, contact));
  }
  // Only contacts that rest breathe: compliance would take speed from a bounce.
  const double softness = rests ? std::min(ownSoftness(state, contact.key.a, contact.key.b),
                                           mostUnderABlow(state, scratch, contact.key, k))
                                : 0.0;
  fillMasses(k, softness, scratch.u[k.a], scratch.u[k.b]);
  if (k.count < source.count()) {  // the second is too close to the first to count
    ContactPoint& point = state.contacts.point(source.points[1]);
    point.lambda_n = point.lambda_t = 0.0;
  }
  return k;
}

void buildBlocks(State& state, Scratch& scratch) {
  constexpr std::size_t kGrain = 64;  // blocks
  scratch.islands.clear();
  const auto& order = scratch.block_order;
  const auto size = static_cast<std::uint32_t>(order.size());
  resizeTightly(scratch.blocks, size);
  forEachIndex(scratch.tasks, size, kGrain, [&](std::size_t i, int) {
    scratch.blocks[i] = makeBlock(state, scratch, scratch.row_sources[order[i].source()]);
  });
  for (std::uint32_t first = 0, last = 0; first < size; first = last) {
    while (last < size && order[last].island() == order[first].island()) ++last;
    Island island{.root = order[first].island(), .first = first, .last = last};
    for (std::uint32_t i = first; i < last; ++i) {
      island.hits |= scratch.blocks[i].hits != 0;
    }
    scratch.islands.push_back(island);
  }
}

/// The bodies of each island, so that sweeps of one island touch nothing else.
template <class Visit>
void forEachMover(const State& state, const Scratch& scratch, Visit&& visit) {
  const auto ask = [&](std::uint32_t r) {
    if (scratch.u[r].inv_mass != 0.0 && scratch.colours[r] != 0) visit(r);
  };
  for (const RigidId id : state.present) ask(static_cast<std::uint32_t>(id));
  for (const BodyId b : scratch.open_members) ask(static_cast<std::uint32_t>(b));
}

void listIslandBodies(const State& state, Scratch& scratch) {
  auto& island_of = scratch.island_of;
  for (std::size_t i = 0; i < scratch.islands.size(); ++i) {
    island_of[scratch.islands[i].root] = static_cast<std::int32_t>(i);
  }
  for (auto& island : scratch.islands) island.first_body = island.last_body = 0;
  forEachMover(state, scratch, [&](std::uint32_t r) {
    island_of[r] = island_of[scratch.sets.find(r)];
    ++scratch.islands[static_cast<std::size_t>(island_of[r])].last_body;
  });
  std::uint32_t begin = 0;
  for (auto& island : scratch.islands) {
    const std::uint32_t count = island.last_body;
    island.first_body = island.last_body = begin;
    begin += count;
  }
  scratch.island_bodies.resize(begin);
  forEachMover(state, scratch, [&](std::uint32_t r) {
    auto& island = scratch.islands[static_cast<std::size_t>(island_of[r])];
    scratch.island_bodies[island.last_body++] = r;
  });
  if (scratch.open_members.empty()) return;
  for (const auto& island : scratch.islands) {
    const auto bodies = scratch.island_bodies.begin();
    std::sort(bodies + island.first_body, bodies + island.last_body);
  }
}

}  // namespace

double contactBias(const SolverSettings& settings, double h, double gap, bool bilateral) {
  if (gap > 0.0) return bilateral ? std::min(gap / h, settings.max_correction) : gap / h;
  if (settings.stabilisation == Stabilisation::Post) return 0.0;
  return std::max(settings.erp * gap / h, -settings.max_correction);
}

double contactSize(const State& state, BodyId a, BodyId b) {
  double size = std::numeric_limits<double>::infinity();
  for (const BodyId body : {a, b}) {
    if (!state.responds(body)) continue;
    size = std::min(size, 2.0 * state.extent(rigidOf(body)).box.half.minCoeff());
  }
  return size;
}

double contactSoftness(const State& state, BodyId a, BodyId b, double inv_mass_a,
                       double inv_mass_b) {
  if (state.settings.solver.stabilisation == Stabilisation::Post) return 0.0;
  const double fall = state.gravity.norm() * state.h * state.h;
  const double size = contactSize(state, a, b);
  const double compliance = complianceFor(state.settings.solver, size, fall);
  return compliance * (inv_mass_a + inv_mass_b);
}

void buildRows(State& state, Scratch& scratch) {
  startVelocities(state, scratch);
  orderKicks(state, scratch);  // bodies may have left their collections
  scratch.row_sources.clear();
  reserveTightly(scratch.row_sources, scratch.pairs.size());
  for (const BodyPair& pair : scratch.pairs) listSources(state, pair, scratch);
  listInnerSources(state, scratch);
  orderBlocks(state, scratch);
  buildBlocks(state, scratch);
  buildJointBlocks(state, scratch);
  listIslandBodies(state, scratch);
}

}  // namespace merge2d
