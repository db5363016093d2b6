#include "src2d/relaxation/region_members.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src2d/proofs/decided_settings.h"
#include "src2d/proofs/proof_impulses.h"

namespace merge2d {

bool isInside(const Scratch& scratch, const Collection& c, std::uint32_t node) {
  return isFrame(c, node) || scratch.open[index(c.members[node])] != 0;
}

void addIfOutside(State& state, Scratch& scratch, OpenRegion& region, std::uint32_t member) {
  const Collection& c = state.collections[region.slot];
  if (!isInside(scratch, c, member)) addMember(state, scratch, region, member);
}

void addMember(State& state, Scratch& scratch, OpenRegion& region, std::uint32_t member) {
  const Collection& c = state.collections[region.slot];
  const BodyId b = c.members[member];
  Rigid& r = state[rigidOf(b)];
  r.x = state.pose(b).position;
  r.rest = Vec2::Zero();
  if (!region.whole) {
    for (const std::uint32_t w : c.welds_of[member]) {
      const std::uint32_t other = otherEnd(c.welds[w], member);
      if (!isFrame(c, other) && isInside(scratch, c, other)) continue;  // they are kept already
      forEachBlock(c, c.welds[w], [&](std::uint32_t block) {
        region.before.emplace_back(block, c.blocks[block].lambda);
      });
    }
  }
  scratch.open[index(b)] = 1;
  scratch.open_start[index(b)] = startOf(state, c, b);
  region.members.push_back(member);
}

void addOthers(State& state, Scratch& scratch, OpenRegion& region) {
  const Collection& c = state.collections[region.slot];
  for (std::uint32_t m = 0; m < c.members.size(); ++m) addIfOutside(state, scratch, region, m);
}

void addAll(State& state, Scratch& scratch, OpenRegion& region) {
  Collection& c = state.collections[region.slot];
  region.whole = true;
  readImpulses(c, c.certificate.front().search.load);
  for (std::uint32_t m = 0; m < c.members.size(); ++m) addMember(state, scratch, region, m);
}

Twist startOf(const State& state, const Collection& c, BodyId member) {
  const Rigid& whole = state[c.rigid];
  const Vec2 arm = whole.previous_rotation * (state[member].local - whole.center);
  const Vec2 v = whole.v + cross(whole.omega, arm);
  return {v.x(), v.y(), whole.omega};
}

Twist leftOver(const Collection& c, std::uint32_t member, const Twist& load) {
  const Twist& push = c.push.of[member];
  return {load.vx + push.vx, load.vy + push.vy, load.omega + push.omega};
}

double cornerSpeed(const State& state, const Collection& c, std::uint32_t member, const Twist& u) {
  const double reach = state.extent(rigidOf(c.members[member])).box.half.norm();
  return Vec2(u.vx, u.vy).norm() + reach * std::abs(u.omega);
}

double slowestCut(const State& state, const Collection& c, std::uint32_t member) {
  double slowest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t w : c.welds_of[member]) {
    slowest = std::min(slowest, cutSpeed(state, c, c.welds[w]));
  }
  return slowest;
}

}  // namespace merge2d
