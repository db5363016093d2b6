#include "src2d/relaxation/imbalance.h"

#include <algorithm>
#include <iterator>

#include "src2d/collections/inner_push.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/relaxation/region_members.h"

namespace merge2d {

Imbalance::Imbalance(const State& state, Collection& c, const CollectionLoad& load)
    : state_(state), c_(c), load_(load) {
  layOutPush(state, c);
  if (c.push.frame != load.frame || c.push.tolerance != toleratedResidual(state)) look();
}

void Imbalance::look() {
  InnerPush& push = c_.push;
  push.frame = load_.frame;
  push.tolerance = toleratedResidual(state_);
  push.unbalanced.clear();
  push.fastest = 0.0;
  for (std::uint32_t m = 0; m < c_.members.size(); ++m) {
    const double speed = cornerSpeed(state_, c_, m, leftOver(c_, m, ofFrame(m)));
    if (speed > push.tolerance) {
      push.unbalanced.push_back(m);
    } else {
      push.fastest = std::max(push.fastest, speed);
    }
  }
}

Twist Imbalance::ofFrame(std::uint32_t member) const {
  return velocityAt(state_, c_, load_.frame, state_[c_.members[member]].local);
}

Twist Imbalance::of(std::uint32_t member) const {
  const auto outer = std::ranges::lower_bound(load_.outer, member, {}, &OuterLoad::member);
  const bool acted_on = outer != load_.outer.end() && outer->member == member;
  return leftOver(c_, member, acted_on ? memberGain(state_, c_, load_, *outer) : ofFrame(member));
}

std::vector<MemberLoad> Imbalance::unbalanced() const {
  std::vector<std::uint32_t> acted_on, members;
  for (const OuterLoad& outer : load_.outer) acted_on.push_back(outer.member);
  std::set_union(c_.push.unbalanced.begin(), c_.push.unbalanced.end(), acted_on.begin(),
                 acted_on.end(), std::back_inserter(members));
  std::vector<MemberLoad> loads;
  for (const std::uint32_t m : members) loads.push_back({m, of(m)});
  return loads;
}

}  // namespace merge2d
