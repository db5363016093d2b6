#pragma once
/// The rows inside a collection that a disturbance reaches.

#include <functional>
#include <span>

#include "src2d/core/index_set.h"
#include "src2d/relaxation/block_sweeps.h"

namespace merge2d {

/// All rows at members at which some row has had a residual above the tolerance. They only grow.
class ReachedRows {
 public:
  static constexpr int kRound = 10;  ///< sweeps after which the residuals are looked at

  /// `admit` is called for each member at these rows, when it joins.
  ReachedRows(const BlockSweeps& sweeps, const Collection& c,
              std::function<void(std::uint32_t)> admit)
      : sweeps_(sweeps),
        c_(c),
        admit_(std::move(admit)),
        hot_(c.members.size()),
        known_(c.members.size(), 0) {}

  /// Looks at blocks; returns the largest residual among them [m/s]. The collection's welds must be
  /// listed by member.
  double look(std::span<const std::uint32_t> blocks);

  /// Looks at those that sweeps over the rows may have changed.
  double lookAgain();

  std::span<const std::uint32_t> blocks() const { return blocks_; }
  std::span<const BodyId> bodies() const { return bodies_; }

 private:
  /// Calls `visit` with the members of a block.
  template <class Visit>
  void forEachMember(std::uint32_t block, Visit&& visit) const;

  const BlockSweeps& sweeps_;
  const Collection& c_;
  std::function<void(std::uint32_t)> admit_;
  IndexSet hot_;                                 ///< members at a row with a residual
  std::vector<std::uint8_t> known_;              ///< per member: whether it was admitted
  std::vector<std::uint32_t> blocks_, members_;  ///< the rows, and the members at them
  std::vector<BodyId> bodies_;                   ///< the same members
};

}  // namespace merge2d
