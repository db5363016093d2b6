#include "src2d/relaxation/region_loads.h"

#include <algorithm>

#include "src2d/collections/inner_push.h"
#include "src2d/proofs/collection_load.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/relaxation/load_path.h"
#include "src2d/relaxation/outer_pushes.h"
#include "src2d/relaxation/region_members.h"

namespace merge2d {
namespace {

/// Whether a weld of the member parts at that velocity.
bool isFast(const State& state, const Collection& c, std::uint32_t member, const Twist& u) {
  const double speed = cornerSpeed(state, c, member, u);
  return speed > cutSpeed(state) && speed > slowestCut(state, c, member);
}

/// Whether contacts can pass it on, but for a residual.
bool findPath(const State& state, const Collection& c, const MemberLoad& one, LoadPath& path) {
  return path.find(one, kDecided.tolerance * slowestCut(state, c, one.member));
}

std::vector<MemberLoad> findUnbalanced(const State& state, Collection& c,
                                       const CollectionLoad& load) {
  std::vector<MemberLoad> found = Imbalance(state, c, load).unbalanced();
  std::erase_if(found,
                [&](const MemberLoad& one) { return !isFast(state, c, one.member, one.gain); });
  return found;
}

/// Passes the rest of the load on, but of members on which something acts from outside. It lasts,
/// so the impulses stay. False where contacts cannot.
bool passOn(const State& state, const Scratch& scratch, Collection& c, const CollectionLoad& load,
            std::vector<MemberLoad> unbalanced) {
  std::erase_if(unbalanced, [&](const MemberLoad& one) {
    return std::ranges::binary_search(load.outer, one.member, {}, &OuterLoad::member);
  });
  if (unbalanced.empty()) return true;
  LoadPath path(state, scratch, c);
  if (!path.find(unbalanced, load.frame, toleratedResidual(state))) return false;
  path.apply(c);
  renewPush(state, c, path.members());
  return true;
}

void addMet(State& state, Scratch& scratch, const Collection& c, OpenRegion& region) {
  for (const Meeting& meeting : scratch.meetings) {
    const BodyPair& pair = scratch.pairs[meeting.pair];
    for (const BodyId b : {pair.a, pair.b}) {
      if (state[b].rigid == c.rigid) addIfOutside(state, scratch, region, state[rigidOf(b)].member);
    }
  }
}

}  // namespace

Twist slowPartOf(const State& state, const Collection& c, const Imbalance& imbalance,
                 std::uint32_t member) {
  const Twist left = imbalance.of(member);
  return isFast(state, c, member, left) ? Twist() : left;
}

void addUnbalanced(State& state, Scratch& scratch, Collection& c, OpenRegion& region) {
  const CollectionLoad load = loadOn(state, scratch, c);
  region.outer.assign(load.outer.begin(), load.outer.end());
  const std::vector<MemberLoad> unbalanced = findUnbalanced(state, c, load);
  region.passes = isHit(state, c) && passOn(state, scratch, c, load, unbalanced);
  if (region.passes) return;
  addMet(state, scratch, c, region);
  for (const MemberLoad& one : unbalanced) addIfOutside(state, scratch, region, one.member);
}

std::vector<std::uint32_t> findDisturbed(const State& state, const Scratch& scratch, Collection& c,
                                         bool passes) {
  const CollectionLoad load = loadOn(state, scratch, c);
  LoadPath path(state, scratch, c);
  std::vector<std::uint32_t> disturbed;
  for (const OuterLoad& outer : relievedLoads(state, scratch, c, load)) {
    const std::uint32_t m = outer.member;
    if (isInside(scratch, c, m)) continue;
    const MemberLoad one{m, leftOver(c, m, memberGain(state, c, load, outer))};
    if (!isFast(state, c, m, one.gain)) continue;
    if (passes && findPath(state, c, one, path)) {
      path.apply(c);
    } else {
      disturbed.push_back(m);
    }
  }
  path.restore(c);  // a hit is no load that lasts
  return disturbed;
}

}  // namespace merge2d
