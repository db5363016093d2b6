/// Rows that are made four at a time.

#include <limits>

#include "src2d/dynamics/hit_rows.h"
#include "src2d/dynamics/row_sources.h"
#include "src2d/dynamics/rows.h"
#include "src2d/dynamics/solver.h"

namespace merge2d {
namespace {

/// A mass whose inverse is `ownInverseMass` [kg].
double ownMass(const State& state, BodyId b) {
  return state.responds(b) ? state[b].mass : std::numeric_limits<double>::infinity();
}

bool isPlainPair(const Body& a, const Body& b) {
  return a.restitution == 0.0 && b.restitution == 0.0 && !a.magnet_on && !b.magnet_on;
}

RowSettings rowSettings(const State& state) {
  const SolverSettings& solver = state.settings.solver;
  return {.h = state.h,
          .erp = solver.erp,
          .max_correction = solver.max_correction,
          .margin = solver.margin,
          .compliance = solver.compliance,
          .fall = state.gravity.norm() * state.h * state.h};
}

}  // namespace

ContactRows::ContactRows(State& state, Scratch& scratch)
    : state_(state), scratch_(scratch), settings_(rowSettings(state)) {}

bool ContactRows::isPlain(std::uint32_t block) const {
  const RowSource& source = sourceOf(block);
  if (scratch_.block_order[block].colour() == BlockOrder::kMixed || source.isInner()) return false;
  if (state_.settings.solver.stabilisation == Stabilisation::Post) return false;
  const Contact& contact = state_.contacts.contactOf(source.points[0]);
  const auto [a, b] = std::pair(contact.key.a, contact.key.b);
  if (!isPlainPair(state_[a], state_[b])) return false;
  if (source.count() == 1 && rollingOf(state_, a, b) > 0.0) return false;
  if (!scratch_.casts.empty() && castToHit(state_, scratch_, contact)) return false;
  return scratch_.open.empty() || !areOnTwoFrames(state_.rigid(a), state_.rigid(b));
}

PackedAs ContactRows::makeUnlessPlain(std::uint32_t block) {
  if (isPlain(block)) {
    return sourceOf(block).count() == 2 ? PackedAs::PlainPair : PackedAs::PlainSingle;
  }
  make(block);
  return packedAs(scratch_.blocks[block]);
}

void ContactRows::gather(std::uint32_t block, std::size_t lane, WideBlock& group, FourContacts& to,
                         Impulses& impulses) {
  const RowSource& source = sourceOf(block);
  const Contact& contact = state_.contacts.contactOf(source.points[0]);
  const ContactKey& key = contact.key;
  const RowEnds ends = endsOf(state_, scratch_, source);
  const Vec2 &center_a = state_[ends.a].x, &center_b = state_[ends.b].x;
  const Pose pose = state_.pose(key.a);
  group.a[lane] = static_cast<std::uint32_t>(ends.a);
  group.b[lane] = static_cast<std::uint32_t>(ends.b);
  group.mu[lane] = frictionOf(state_, key.a, key.b);
  to.nx[lane] = contact.normal.x();
  to.ny[lane] = contact.normal.y();
  to.x[lane] = pose.position.x();
  to.y[lane] = pose.position.y();
  to.c[lane] = pose.rotation.c;
  to.s[lane] = pose.rotation.s;
  to.center_ax[lane] = center_a.x();
  to.center_ay[lane] = center_a.y();
  to.center_bx[lane] = center_b.x();
  to.center_by[lane] = center_b.y();
  to.mass_a[lane] = ownMass(state_, key.a);
  to.mass_b[lane] = ownMass(state_, key.b);
  to.size[lane] = contactSize(state_, key.a, key.b);
  impulses = {};
  for (std::size_t i = 0; i < static_cast<std::size_t>(group.points); ++i) {
    ContactPoint& point = state_.contacts.point(source.points[i]);
    point.struck = 0.0F;
    to.px[i][lane] = point.position.x();
    to.py[i][lane] = point.position.y();
    to.gap[i][lane] = point.gap;
    impulses[i] = point.lambda_n;
    impulses[i + 2] = point.lambda_t;
  }
}

void ContactRows::makeGroup(WideBlocks& wide, WideBlock& group, std::uint32_t first,
                            SweepPath path) {
  FourContacts of;
  if (!wide.isFull(group)) of = FourContacts();
  for (std::size_t lane = 0; lane < 4; ++lane) {
    const std::uint32_t block = group.block[lane];
    if (wide.isUsed(group, lane)) gather(first + block, lane, group, of, wide.impulses()[block]);
  }
  wideKernels(path).make_rows(of, settings_, scratch_.u.data(), group);
  if (!wide.isFull(group)) wide.clearUnused(group);
}

void ContactRows::storeGroup(WideBlocks& wide, const WideBlock& group, std::uint32_t first,
                             SweepPath path) {
  FourContactVelocities w;
  wideKernels(path).velocities(group, scratch_.u.data(), w);
  for (std::size_t lane = 0; lane < 4; ++lane) {
    if (!wide.isUsed(group, lane)) continue;
    const RowSource& source = sourceOf(first + group.block[lane]);
    const Impulses& impulses = wide.impulses()[group.block[lane]];
    if (source.isInner()) {
      state_.collections[source.slot()].blocks[source.block()].lambda = impulses;
      continue;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(group.points); ++i) {
      ContactPoint& point = state_.contacts.point(source.points[i]);
      point.lambda_n = impulses[i];
      point.lambda_t = impulses[i + 2];
      point.w_n = static_cast<float>(w.n[i][lane]);
      point.w_t = static_cast<float>(w.t[i][lane]);
    }
  }
}

}  // namespace merge2d
