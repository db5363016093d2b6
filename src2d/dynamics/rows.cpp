/// Rows that are made one by one.

#include "src2d/dynamics/rows.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "src2d/core/memory.h"
#include "src2d/dynamics/casts.h"
#include "src2d/dynamics/free_motion.h"
#include "src2d/dynamics/hit_rows.h"
#include "src2d/dynamics/island_order.h"
#include "src2d/dynamics/joint_rows.h"
#include "src2d/dynamics/row_sources.h"
#include "src2d/dynamics/solver.h"
#include "src2d/dynamics/start_velocities.h"
#include "src2d/scene/compliance.h"

namespace merge2d {
namespace {

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
  const auto velocity = [&](const SolverVelocity& a, const SolverVelocity& b) {
    return contactVelocity(k, i, k.nx, k.ny, a, b).n;
  };
  const auto atStart = [&] {
    return velocity(velocityAtStart(state, scratch, k.a), velocityAtStart(state, scratch, k.b));
  };
  const SolverSettings& settings = state.settings.solver;
  k.bias[i] = k.bilateral ? bilateralBias(settings, state.h, gap, -atStart())
                          : contactBias(settings, state.h, gap);
  const bool elastic = restitutionOf(state, contact.key.a, contact.key.b) > 0.0;
  if (elastic || end) {
    const double w_free = velocity(scratch.u[k.a], scratch.u[k.b]);
    const double w_start = atStart();
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

/// Lever arms of the points of a block: as they are now, or where they are `hits` of a cast as they
/// will be there. A row of the full solve acts on both bodies at one place, or it would change
/// their angular momentum. Guarded by FollowedHits.ThoseOfOneCornerKeepTheAngularMomentum.
void setArms(const State& state, const Scratch& scratch, const RowSource& source, const Cast* cast,
             unsigned hits, const ContactBlock& k, BlockGeometry& g) {
  const Contact& contact = state.contacts.contactOf(source.points[0]);
  const Pose pose_a = state.pose(contact.key.a);
  const Vec2 &center_a = state.rigids[k.a].x, &center_b = state.rigids[k.b].x;
  for (std::size_t i = 0; i < static_cast<std::size_t>(source.count()); ++i) {
    const ContactPoint& point = state.contacts.point(source.points[i]);
    const CastEnd* end = nullptr;
    if (cast && (hits >> i & 1) != 0) {
      end = castOf(scratch, state.contacts.contactOf(source.points[i]), point);
    }
    const Vec2 p = pose_a * point.position;
    g.arm_a[i] = p - center_a;
    g.arm_b[i] = (end ? state.pose(contact.key.b) * end->on_b : p) - center_b;
  }
}

/// Fills the rows of a block but for their effective masses, with the impulses of the last step as
/// a start; those of the points in `hits` as they were `cast` to. True when some of it rests.
bool aimBlock(State& state, const Scratch& scratch, const RowSource& source, const Cast* cast,
              unsigned hits, BlockGeometry& g, ContactBlock& k) {
  setArms(state, scratch, source, cast, hits, k, g);
  setArms(k, g);
  bool rests = false;
  for (int i = 0; i < source.count(); ++i) {
    const PointIndex place = source.points[static_cast<std::size_t>(i)];
    ContactPoint& point = state.contacts.point(place);
    k.lambda_n(i) = point.lambda_n;
    k.lambda_t(i) = point.lambda_t;
    rests |= aimRow(state, scratch, state.contacts.contactOf(place), point, k, i,
                    (hits >> i & 1) != 0 ? cast : nullptr);
  }
  return rests;
}

/// The rows of one block.
void fillBlock(State& state, const Scratch& scratch, RowSource& source, ContactBlock& k) {
  if (source.isInner()) {
    const Collection& c = state.collections[source.slot()];
    k = turned(state[c.rigid].rotation, c.blocks[source.block()]);
    return;
  }
  const Contact& contact = state.contacts.contactOf(source.points[0]);
  const RowEnds ends = endsOf(state, scratch, source);
  BlockGeometry g;
  g.normal = state.pose(contact.key.a).rotation * contact.normal;
  g.count = source.count();
  k = {};
  k.a = static_cast<std::uint32_t>(ends.a);
  k.b = static_cast<std::uint32_t>(ends.b);
  k.mu = frictionOf(state, contact.key.a, contact.key.b);
  const Contact& last = state.contacts.contactOf(source.points[source.count() == 2 ? 1 : 0]);
  k.bilateral = isHeld(state, contact) || isHeld(state, last);
  const Cast* cast = scratch.casts.empty() ? nullptr : castToHit(state, scratch, contact);
  const unsigned all = source.count() == 2 ? 3U : 1U;
  bool rests = aimBlock(state, scratch, source, cast, all, g, k);
  if (cast && k.hits != all) {
    const unsigned hits = std::exchange(k.hits, std::uint8_t{0});
    rests = aimBlock(state, scratch, source, cast, hits, g, k);
    k.hits = static_cast<std::uint8_t>(k.hits | hits << 2U);
  } else if (cast) {
    k.hits = static_cast<std::uint8_t>(all | all << 2U);
  }
  if (source.count() == 1 && k.hits == 0) {
    k.setRolling(rollingOf(state, contact.key.a, contact.key.b), rollingImpulse(state, contact));
  }
  // Between two frames nothing sinks in any further, as inside a collection: with a feedback of the
  // overlap the contact would let go of the load that it bore when the two merged. Guarded by
  // SlowLoad.AFrameBearsWhatItBoreWhenItBeginsToMove.
  const bool frozen = areOnTwoFrames(state.rigid(contact.key.a), state.rigid(contact.key.b));
  for (int i = 0; frozen && i < k.count; ++i) k.bias[i] = std::max(0.0, k.bias[i]);
  // Only contacts that rest breathe: compliance would take speed from a bounce.
  const double softness = rests && !frozen
                              ? std::min(ownSoftness(state, contact.key.a, contact.key.b),
                                         mostUnderABlow(state, scratch, contact.key, k))
                              : 0.0;
  fillMasses(k, softness, scratch.u[k.a], scratch.u[k.b]);
  if (k.count < source.count()) {  // the second is too close to the first to count
    ContactPoint& point = state.contacts.point(std::exchange(source.points[1], kNone));
    point.lambda_n = point.lambda_t = 0.0;
  }
}

/// The islands of all blocks, whose rows are made when they are solved.
void listIslands(Scratch& scratch) {
  scratch.islands.clear();
  const auto& order = scratch.block_order;
  const auto size = static_cast<std::uint32_t>(order.size());
  resizeTightly(scratch.blocks, size);
  for (std::uint32_t first = 0, last = 0; first < size; first = last) {
    while (last < size && order[last].island() == order[first].island()) ++last;
    scratch.islands.push_back({.root = order[first].island(), .first = first, .last = last});
  }
}

}  // namespace

double contactBias(const SolverSettings& settings, double h, double gap) {
  if (gap > 0.0) return gap / h;
  if (settings.stabilisation == Stabilisation::Post) return 0.0;
  return std::max(settings.erp * gap / h, -settings.max_correction);
}

double bilateralBias(const SolverSettings& settings, double h, double gap, double closing) {
  if (gap <= 0.0) return contactBias(settings, h, gap);
  const double drawing = std::min(settings.erp * gap / h, settings.max_correction);
  return std::clamp(closing, drawing, gap / h);
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

void ContactRows::make(std::uint32_t block) {
  fillBlock(state_, scratch_, sourceOf(block), scratch_.blocks[block]);
}

void ContactRows::store(std::uint32_t block) {
  const ContactBlock& k = scratch_.blocks[block];
  const RowSource& source = sourceOf(block);
  if (source.isInner()) {
    state_.collections[source.slot()].blocks[source.block()].lambda = k.lambda;
    return;
  }
  for (int p = 0; p < k.count; ++p) {
    ContactPoint& point = state_.contacts.point(source.points[static_cast<std::size_t>(p)]);
    const ContactVelocity w = contactVelocity(k, p, k.nx, k.ny, scratch_.u[k.a], scratch_.u[k.b]);
    point.lambda_n = k.lambda_n(p);
    point.lambda_t = k.lambda_t(p);
    point.w_n = static_cast<float>(w.n);
    point.w_t = static_cast<float>(w.t);
  }
  if (k.rolls()) state_.contacts.secondOf(source.points[0]).lambda_t = k.lambda_r();
}

void listRows(State& state, Scratch& scratch) {
  startVelocities(state, scratch);
  orderKicks(state, scratch);  // bodies may have left their collections
  listRowSources(state, scratch);
  orderBlocks(state, scratch);
  listIslands(scratch);
  buildJointBlocks(state, scratch);
  listIslandBodies(state, scratch);
}

}  // namespace merge2d
