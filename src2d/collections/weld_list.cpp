#include "src2d/collections/weld_list.h"

#include <algorithm>
#include <span>

#include "src2d/core/sorted_tail.h"

namespace merge2d {

const Weld* findWeld(const Collection& c, BodyId a, BodyId b) {
  const std::pair pair(a, b);
  const auto pairAt = [](const Weld& weld) { return pairOf(weld); };
  const auto sorted = std::span(c.welds).first(c.laid_out.sorted_welds);
  const auto at = std::ranges::lower_bound(sorted, pair, {}, pairAt);
  if (at != sorted.end() && pairOf(*at) == pair) return &*at;
  const auto late = std::span(c.welds).subspan(c.laid_out.sorted_welds);
  const auto found = std::ranges::find(late, pair, pairAt);
  return found == late.end() ? nullptr : &*found;
}

void sortWelds(Collection& c) {
  sortTail(c.welds, [](const Weld& x, const Weld& y) { return pairOf(x) < pairOf(y); });
  c.laid_out.sorted_welds = static_cast<std::uint32_t>(c.welds.size());
}

}  // namespace merge2d
