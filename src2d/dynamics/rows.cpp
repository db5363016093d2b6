/// The rows of the full solve: from contacts to blocks, grouped by island.

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <utility>

#include "src2d/dynamics/solver.h"

namespace merge2d {
namespace {

bool simulated(const Rigid& r) { return r.present() && !r.asleep && r.floating(); }

/// u₋ + h M⁻¹ f for everything in B; what is fixed or asleep keeps its velocity.
void startVelocities(const State& state, Scratch& scratch) {
  scratch.u.resize(state.rigids.size());
  for (std::size_t i = 0; i < state.rigids.size(); ++i) {
    const Rigid& r = state.rigids[i];
    SolverVelocity& u = scratch.u[i];
    const bool free = simulated(r);
    u = {r.v.x(), r.v.y(), r.omega, free ? r.inv_mass : 0.0, free ? r.inv_inertia : 0.0};
    if (!free) continue;
    u.vx += state.h * state.gravity.x();
    u.vy += state.h * state.gravity.y();
  }
  for (const Load& load : scratch.loads) {
    const Rigid& r = state.rigid(load.body);
    SolverVelocity& u = scratch.u[index(state[load.body].rigid)];
    const double torque = load.torque + cross(state.pose(load.body).position - r.x, load.force);
    u.vx += state.h * u.inv_mass * load.force.x();
    u.vy += state.h * u.inv_mass * load.force.y();
    u.omega += state.h * u.inv_inertia * torque;
  }
  for (const Kick& kick : scratch.kicks) {
    const Rigid& r = state.rigid(kick.body);
    SolverVelocity& u = scratch.u[index(state[kick.body].rigid)];
    u.vx += u.inv_mass * kick.impulse.x();
    u.vy += u.inv_mass * kick.impulse.y();
    u.omega += u.inv_inertia * cross(kick.at - r.x, kick.impulse);
  }
}

/// Of the body itself, also inside a collection: what a contact yields must not change when one of
/// its bodies merges, or each merge would set everything around it in motion.
double ownInverseMass(const State& state, BodyId b) {
  const bool responds = state[rigidOf(b)].floating() || state.isCollection(state[b].rigid);
  return responds ? 1.0 / state[b].mass : 0.0;
}

/// A gap below this counts as touching when a bounce is due [m].
constexpr double kTouching = 1e-4;

/// Bounces (Newton's law of restitution) happen when the bodies touch, with the speed of the
/// approach remembered from the steps in which the gap was still open: the height of a bounce then
/// does not depend on where in the step the bodies met.
double restitutionBias(const State& state, const Contact& contact, ContactPoint& point,
                       double normal_velocity, double bias) {
  if (contact.restitution == 0.0) return bias;
  point.approach = normal_velocity < 0.0 ? std::max(point.approach, -normal_velocity) : 0.0;
  const bool fast = point.approach > state.settings.solver.restitution_velocity;
  if (!fast || point.gap > kTouching) return bias;
  return std::min(bias, -contact.restitution * std::exchange(point.approach, 0.0));
}

class RowBuilder {
 public:
  RowBuilder(State& state, Scratch& scratch) : state_(state), scratch_(scratch) {}

  /// The blocks of one pair of bodies; points with one normal share a block.
  void addPair(const BodyPair& pair) {
    const RigidId ra = state_[pair.a].rigid, rb = state_[pair.b].rigid;
    const bool a_moves = simulated(state_[ra]), b_moves = simulated(state_[rb]);
    if (!a_moves && !b_moves) return;
    const Pose pose_a = state_.pose(pair.a);
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
      Contact& contact = state_.contacts[state_.contacts.order[i]];
      const Vec2 normal = pose_a.rotation * contact.normal;
      for (std::size_t k = 0; k < static_cast<std::size_t>(contact.count); ++k) {
        addPoint(contact, contact.points[k], ra, rb, pose_a, normal);
      }
      }
    finishBlock();
  }

 private:
  void addPoint(Contact& contact, ContactPoint& point, RigidId ra, RigidId rb, const Pose& pose_a,
                const Vec2& normal) {
    const bool joins = geometry_.count == 1 && geometry_.normal.dot(normal) > 1.0 - 1e-12;
    if (!joins) finishBlock();
    const Vec2 position = pose_a * point.position;
    const auto k = static_cast<std::size_t>(geometry_.count);
    geometry_.normal = normal;
    geometry_.arm_a[k] = position - state_[ra].x;
    geometry_.arm_b[k] = position - state_[rb].x;
    geometry_.count += 1;
    ra_ = ra;
    rb_ = rb;
    contact_ = &contact;
    points_[k] = &point;
    if (geometry_.count == 2) finishBlock();
  }

  void finishBlock() {
    if (geometry_.count == 0) return;
    const SolverVelocity& a = scratch_.u[index(ra_)];
    const SolverVelocity& b = scratch_.u[index(rb_)];
    const SolverSettings& settings = state_.settings.solver;
    geometry_.softness = contactSoftness(settings, ownInverseMass(state_, contact_->key.a),
                                         ownInverseMass(state_, contact_->key.b));
    ContactBlock k;
    k.a = static_cast<std::uint32_t>(ra_);
    k.b = static_cast<std::uint32_t>(rb_);
    k.mu = contact_->mu;
    k.bilateral = state_[contact_->key.a].magnet_on || state_[contact_->key.b].magnet_on;
    prepareBlock(k, geometry_, a, b);
    RowPoints row;
    for (int i = 0; i < k.count; ++i) {
      ContactPoint& point = *points_[i];
      const Rigid &body_a = state_[ra_], &body_b = state_[rb_];
      const Vec2 before = body_b.v + cross(body_b.omega, geometry_.arm_b[i]) - body_a.v -
                          cross(body_a.omega, geometry_.arm_a[i]);
      k.bias[i] = restitutionBias(state_, *contact_, point, geometry_.normal.dot(before),
                                  contactBias(settings, state_.h, point.gap));
      k.lambda_n[i] = point.lambda_n;
      k.lambda_t[i] = point.lambda_t;
      row.point[i] = &point;
    }
    scratch_.blocks.push_back(k);
    scratch_.row_points.push_back(row);
    geometry_ = {};
  }

  State& state_;
  Scratch& scratch_;
  BlockGeometry geometry_;
  RigidId ra_{}, rb_{};
  Contact* contact_ = nullptr;
  ContactPoint* points_[2] = {nullptr, nullptr};
};

/// Orders the blocks by island and, inside it, by colour: blocks of one colour share no body, so
/// that consecutive ones need not wait for each other's results.
void groupByIsland(const State& state, Scratch& scratch) {
  auto& sets = scratch.sets;
  sets.reset(state.rigids.size());
  for (const ContactBlock& k : scratch.blocks) {
    if (scratch.u[k.a].inv_mass > 0.0 && scratch.u[k.b].inv_mass > 0.0) sets.unite(k.a, k.b);
  }

  // Greedy colours, in the order of the blocks.
  scratch.colours.assign(state.rigids.size(), 0);
  auto& order = scratch.block_order;
  order.resize(scratch.blocks.size());
  for (std::uint32_t i = 0; i < scratch.blocks.size(); ++i) {
    const ContactBlock& k = scratch.blocks[i];
    const bool a_moves = scratch.u[k.a].inv_mass > 0.0, b_moves = scratch.u[k.b].inv_mass > 0.0;
    const std::uint64_t used = (a_moves ? scratch.colours[k.a] : 0) |
                               (b_moves ? scratch.colours[k.b] : 0);
    const auto colour = static_cast<std::uint32_t>(std::min(std::countr_one(used), 63));
    const std::uint64_t bit = std::uint64_t{1} << colour;
    if (a_moves) scratch.colours[k.a] |= bit;
    if (b_moves) scratch.colours[k.b] |= bit;
    order[i] = {sets.find(a_moves ? k.a : k.b), getenv("NAT")?0:colour, i};
  }
  std::sort(order.begin(), order.end());

  // Lay the blocks out in that order, and list the islands.
  scratch.islands.clear();
  scratch.sorted_blocks.resize(order.size());
  scratch.sorted_points.resize(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    scratch.sorted_blocks[i] = scratch.blocks[order[i].block];
    scratch.sorted_points[i] = scratch.row_points[order[i].block];
    if (scratch.islands.empty() || scratch.islands.back().root != order[i].island) {
      scratch.islands.push_back({order[i].island, i, i, 0, 0});
    }
    scratch.islands.back().last = i + 1;
  }
  scratch.blocks.swap(scratch.sorted_blocks);
  scratch.row_points.swap(scratch.sorted_points);
}

/// The bodies of each island, so that sweeps of one island touch nothing else.
void listIslandBodies(const State& state, Scratch& scratch) {
  auto& island_of = scratch.island_of;
  island_of.assign(state.rigids.size(), -1);
  for (std::size_t i = 0; i < scratch.islands.size(); ++i) {
    island_of[scratch.islands[i].root] = static_cast<std::int32_t>(i);
  }
  for (auto& island : scratch.islands) island.first_body = island.last_body = 0;
  for (std::uint32_t r = 0; r < state.rigids.size(); ++r) {
    if (scratch.u[r].inv_mass == 0.0 || scratch.colours[r] == 0) continue;
    island_of[r] = island_of[scratch.sets.find(r)];
    ++scratch.islands[static_cast<std::size_t>(island_of[r])].last_body;
  }
  std::uint32_t begin = 0;
  for (auto& island : scratch.islands) {
    const std::uint32_t count = island.last_body;
    island.first_body = island.last_body = begin;
    begin += count;
  }
  scratch.island_bodies.resize(begin);
  for (std::uint32_t r = 0; r < state.rigids.size(); ++r) {
    if (scratch.u[r].inv_mass == 0.0 || scratch.colours[r] == 0) continue;
    auto& island = scratch.islands[static_cast<std::size_t>(island_of[r])];
    scratch.island_bodies[island.last_body++] = r;
  }
}

}  // namespace

double contactBias(const SolverSettings& settings, double h, double gap) {
  if (gap > 0.0) return gap / h;
  return std::max(settings.erp * gap / h, -settings.max_correction);
}

double contactSoftness(const SolverSettings& settings, double inv_mass_a, double inv_mass_b) {
  return settings.compliance * (inv_mass_a + inv_mass_b);
}

void buildRows(State& state, Scratch& scratch) {
  startVelocities(state, scratch);
  scratch.blocks.clear();
  scratch.row_points.clear();
  RowBuilder builder(state, scratch);
  for (const BodyPair& pair : scratch.pairs) builder.addPair(pair);
  groupByIsland(state, scratch);
  listIslandBodies(state, scratch);
}

}  // namespace merge2d
