#pragma once
/// The contact points of an island while hits go on (dynamics/hits.h).

#include <span>
#include <vector>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// A contact point while hits go on.
struct HitPoint {
  static constexpr double kMet = 1e-9;    ///< nearer than this two points have met [m]
  static constexpr double kStill = 1e-9;  ///< slower is no approach, where a point bounces [m/s]
  static constexpr double kSoft = 1e-5;   ///< the same without restitution: 0.1 µm a step [m/s]

  std::uint32_t block = 0;  ///< of the island
  int row = 0;              ///< in the block
  double gap = 0.0;         ///< now [m]
  double touching = 0.0;    ///< a gap up to this is a touch [m]
  double e = 0.0;           ///< restitution
  double least = 0.0;       ///< slower approaches do not bounce [m/s]
  double alpha = 0.0;       ///< how much faster the approach becomes by loads [m/s²]
  double allowed = 0.0;     ///< slower approaches may sink in [m/s]
  double still = kStill;    ///< slower is no approach [m/s]
  bool round = false;       ///< bounces off or on a disc: its normal turns on the way
  bool holds = false;       ///< touches and does not bounce: bears at any hit
  bool meets = false;       ///< takes part in the hit at hand
  std::int32_t rows = -1;   ///< of that hit, or −1
  double target = 0.0;      ///< of w after it [m/s]
  double extra = 0.0;       ///< part of the target that comes from loads [m/s]
};

/// The blocks, joints and bodies of one island of the full solve.
class HitIsland {
 public:
  static constexpr std::uint32_t kFixed = ~0U;

  HitIsland(State& state, Scratch& scratch, const Island& island);

  const State& state() const { return state_; }
  Scratch& scratch() const { return scratch_; }
  std::span<ContactBlock> blocks() const { return blocks_; }
  std::span<JointBlock> joints() const { return joints_; }
  std::span<const std::uint32_t> bodies() const { return bodies_; }  ///< ascending

  SolverVelocity& u(std::uint32_t rigid) const { return scratch_.u[rigid]; }
  double velocityOf(const HitPoint& p) const {
    const ContactBlock& k = blocks_[p.block];
    return contactVelocity(k, p.row, k.nx, k.ny, u(k.a), u(k.b)).n;
  }
  const RowSource& sourceOf(std::uint32_t block) const {
    return scratch_.row_sources[scratch_.block_order[first_ + block].source()];
  }
  /// Whether a block stands inside an open collection, and its points not in the contact table.
  bool isInner(std::uint32_t block) const { return sourceOf(block).isInner(); }
  ContactPoint& pointOf(const HitPoint& p) const {
    return state_.contacts.point(sourceOf(p.block).points[static_cast<std::size_t>(p.row)]);
  }
  /// Its place among the bodies of the island, or kFixed.
  std::uint32_t placeOf(std::uint32_t rigid) const;

 private:
  State& state_;
  Scratch& scratch_;
  std::span<ContactBlock> blocks_;
  std::span<JointBlock> joints_;
  std::span<const std::uint32_t> bodies_;
  std::uint32_t first_;
};

/// The points of an island, in the order of its blocks, after the full solve; also those inside an
/// open collection, which bear at a hit as they would apart.
std::vector<HitPoint> hitPoints(const HitIsland& island);

}  // namespace merge2d
