#include "src2d/dynamics/hit_points.h"

#include <algorithm>

#include "src2d/dynamics/casts.h"
#include "src2d/dynamics/hit_rows.h"

namespace merge2d {

HitIsland::HitIsland(State& state, Scratch& scratch, const Island& island)
    : state_(state),
      scratch_(scratch),
      blocks_(scratch.blocks.data() + island.first, island.last - island.first),
      joints_(scratch.joint_blocks.data() + island.first_joint,
              island.last_joint - island.first_joint),
      bodies_(scratch.island_bodies.data() + island.first_body,
              island.last_body - island.first_body),
      first_(island.first) {}

std::uint32_t HitIsland::placeOf(std::uint32_t rigid) const {
  const auto at = std::ranges::lower_bound(bodies_, rigid);
  const bool moves = at != bodies_.end() && *at == rigid;
  return moves ? static_cast<std::uint32_t>(at - bodies_.begin()) : kFixed;
}

namespace {

/// How much faster the two come towards each other by loads [m/s²]: no more than these can.
double loadOf(const HitIsland& island, const ContactBlock& k, int row, double w) {
  const State& state = island.state();
  const SolverVelocity a = velocityAtStart(state, island.scratch(), k.a);
  const SolverVelocity b = velocityAtStart(state, island.scratch(), k.b);
  const double w_start = contactVelocity(k, row, k.nx, k.ny, a, b).n;
  const double most = 2.0 * state.gravity.norm();
  return std::clamp((w_start - w) / state.h, -most, most);
}

HitPoint hitPoint(const HitIsland& island, std::uint32_t block, int row) {
  const State& state = island.state();
  const Contact& contact = state.contacts.contactOf(island.sourceOf(block).points[0]);
  const ContactBlock& k = island.blocks()[block];
  const ContactKey& key = contact.key;
  HitPoint p{.block = block, .row = row};
  const ContactPoint& point = island.pointOf(p);
  const bool hit = (k.hits >> row & 1) != 0;
  const bool cast = (k.hits >> (2 + row) & 1) != 0;
  const CastEnd* end = cast ? castOf(island.scratch(), contact, point) : nullptr;
  p.gap = end ? end->carried : point.gap;
  p.e = k.bilateral ? 0.0 : restitutionOf(state, key.a, key.b);
  p.still = p.e > 0.0 || k.bilateral ? HitPoint::kStill : HitPoint::kSoft;
  const bool is_disc =
      state.collider(key.shape_a).isCircle() || state.collider(key.shape_b).isCircle();
  p.round = is_disc && p.e > 0.0 && k.count == 1;
  p.touching = touchingGap(state, key);
  p.least = leastBounce(state, key);
  const double w = island.velocityOf(p);
  p.holds = k.bilateral || (p.e == 0.0 && !hit && p.gap <= p.touching);
  if (!hit && p.gap <= p.touching) p.allowed = std::min(0.0, w);
  p.alpha = loadOf(island, k, row, w);
  return p;
}

/// Inside an open collection, where nothing bounces. Where a bounce arrives, the step is solved
/// again without the welds (merging/bounces.h).
HitPoint innerPoint(const HitIsland& island, std::uint32_t block, int row) {
  const RowSource& source = island.sourceOf(block);
  const Collection& c = island.state().collections[source.slot()];
  const InternalContact& contact = c.contacts[c.block_contact[source.block()]];
  const bool bilateral = island.blocks()[block].bilateral;
  HitPoint p{.block = block, .row = row};
  p.gap = contact.gap[static_cast<std::size_t>(row)];
  p.still = bilateral ? HitPoint::kStill : HitPoint::kSoft;
  p.touching = touchingGap(island.state(), contact.key);
  p.holds = bilateral || p.gap <= p.touching;
  if (p.gap <= p.touching) p.allowed = std::min(0.0, island.velocityOf(p));
  return p;
}

}  // namespace

std::vector<HitPoint> hitPoints(const HitIsland& island) {
  std::vector<HitPoint> points;
  points.reserve(2 * island.blocks().size());
  for (std::uint32_t block = 0; block < island.blocks().size(); ++block) {
    for (int row = 0; row < island.blocks()[block].count; ++row) {
      points.push_back(island.isInner(block) ? innerPoint(island, block, row)
                                             : hitPoint(island, block, row));
    }
  }
  return points;
}

}  // namespace merge2d
