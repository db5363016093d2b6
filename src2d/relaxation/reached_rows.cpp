#include "src2d/relaxation/reached_rows.h"

#include <algorithm>
#include <utility>

#include "src2d/relaxation/open_region.h"

namespace merge2d {

template <class Visit>
void ReachedRows::forEachMember(std::uint32_t block, Visit&& visit) const {
  const Weld& weld = c_.weldOf(block);
  for (const std::uint32_t m : {weld.node_a, weld.node_b}) {
    if (m < c_.members.size()) visit(m);
  }
}

double ReachedRows::look(std::span<const std::uint32_t> blocks) {
  double most = 0.0;
  bool grows = false;
  for (const std::uint32_t i : blocks) {
    const double residual = sweeps_.residual(i);
    most = std::max(most, residual);
    if (residual <= sweeps_.tolerance) continue;
    forEachMember(i, [&](std::uint32_t m) { grows |= hot_.add(m); });
  }
  if (!grows) return most;
  blocks_ = blocksAt(c_, hot_.ascending());
  IndexSet ends(c_.members.size());
  for (const std::uint32_t i : blocks_) forEachMember(i, [&](std::uint32_t m) { ends.add(m); });
  members_ = ends.ascending();
  bodies_.clear();
  for (const std::uint32_t m : members_) {
    if (!std::exchange(known_[m], 1)) admit_(m);
    bodies_.push_back(c_.members[m]);
  }
  return most;
}

double ReachedRows::lookAgain() { return look(blocksAt(c_, members_)); }

}  // namespace merge2d
