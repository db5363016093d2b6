#include "src2d/relaxation/open_region.h"

#include <algorithm>

#include "src2d/collections/collection.h"
#include "src2d/collections/inner_push.h"
#include "src2d/core/index_set.h"
#include "src2d/proofs/collection_load.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/proofs/proof_impulses.h"
#include "src2d/relaxation/region_loads.h"
#include "src2d/relaxation/region_members.h"

namespace merge2d {
namespace {

/// A search has found motion, which may be that of any member.
bool wasSearched(const Collection& c) { return c.certificate.front().search.hasFoundMotion(); }

/// Members that must be on their own: only then they have rows against other frames, and an impulse
/// of the user acts on them alone.
void addOwn(State& state, Scratch& scratch, const Collection& c, OpenRegion& region) {
  const auto touch = [&](BodyId b) {
    if (state[b].rigid == c.rigid) addIfOutside(state, scratch, region, state[rigidOf(b)].member);
  };
  for (const Kick& kick : scratch.kicks) touch(kick.body);
  for (const BodyPair& pair : scratch.pairs) {
    if (!areOnTwoFrames(state.rigid(pair.a), state.rigid(pair.b))) continue;
    touch(pair.a);
    touch(pair.b);
  }
  for (const std::uint32_t i : state.joint_lists.present) {
    const Joint& joint = state.joints[i];
    if (!holds(state, joint) || !isOnTwoFrames(state, joint)) continue;
    touch(joint.a);
    if (!joint.to_world) touch(joint.b);
  }
}

/// Rings of neighbours around members of the region.
void addAround(State& state, Scratch& scratch, OpenRegion& region, std::size_t first) {
  const Collection& c = state.collections[region.slot];
  for (int i = 0; i < region.rings; ++i) {
    const std::size_t end = region.members.size();
    for (; first < end; ++first) {
      const std::uint32_t m = region.members[first];
      for (const std::uint32_t w : c.welds_of[m]) {
        addIfOutside(state, scratch, region, otherEnd(c.welds[w], m));
      }
    }
  }
  region.rings *= 2;
}

/// A region that leaves but a small part of the members outside takes them all: to go on in rings
/// costs more solves than it saves rows.
void completeMost(State& state, Scratch& scratch, const Collection& c, OpenRegion& region) {
  const std::size_t outside = c.members.size() - region.members.size();
  if (isSmallPart(outside, c.members.size())) addOthers(state, scratch, region);
}

/// Calls `visit` with each block between a member inside and one outside.
template <class Visit>
void forEachHeld(const Scratch& scratch, const Collection& c, const OpenRegion& region,
                 Visit&& visit) {
  if (region.whole) return;
  for (const std::uint32_t in : region.members) {
    for (const std::uint32_t w : c.welds_of[in]) {
      const std::uint32_t out = otherEnd(c.welds[w], in);
      if (isInside(scratch, c, out)) continue;
      forEachBlock(c, c.welds[w], [&](std::uint32_t block) { visit(c.blocks[block], in, out); });
    }
  }
}

/// The velocity with which a member goes into the full solve, but for a slow one that the impulses
/// inside leave it.
void startMember(State& state, const Scratch& scratch, const Collection& c, std::uint32_t member,
                 const Twist& left) {
  const BodyId b = c.members[member];
  const Twist& start = scratch.open_start[index(b)];
  const Vec2 v = state[c.rigid].rotation * Vec2(left.vx, left.vy);
  Rigid& r = state[rigidOf(b)];
  r.v = Vec2(start.vx, start.vy) - v;
  r.omega = start.omega - left.omega;
}

void startMembers(State& state, const Scratch& scratch, Collection& c, const OpenRegion& region) {
  if (region.whole) {
    for (const std::uint32_t m : region.members) startMember(state, scratch, c, m, {});
    return;
  }
  CollectionLoad load = loadOn(state, scratch, c);
  load.outer = region.outer;
  const Imbalance imbalance(state, c, load);
  for (const std::uint32_t m : region.members) {
    startMember(state, scratch, c, m, slowPartOf(state, c, imbalance, m));
  }
}

/// The impulses that contacts at the border hold.
void pushFromOutside(State& state, const Scratch& scratch, const Collection& c,
                     const OpenRegion& region) {
  forEachHeld(scratch, c, region, [&](const ContactBlock& inner, std::uint32_t in, std::uint32_t) {
    const BodyId b = c.members[in];
    Rigid& r = state[rigidOf(b)];
    SolverVelocity u = memberVelocity(state, b, {r.v.x(), r.v.y(), r.omega}), rest;
    const bool is_a = inner.a == index(b);
    applyImpulses(turned(state[c.rigid].rotation, inner), is_a ? u : rest, is_a ? rest : u);
    r.v = {u.vx, u.vy};
    r.omega = u.omega;
  });
}

}  // namespace

SolverVelocity solvedVelocity(const State& state, const Scratch& scratch, BodyId b) {
  const RigidId mover = moverOf(state, scratch, b);
  SolverVelocity u = scratch.u[index(mover)];
  if (mover == rigidOf(b)) return u;
  const Vec2 arm = state.pose(b).position - state[mover].x;
  u.vx -= u.omega * arm.y();
  u.vy += u.omega * arm.x();
  return u;
}

void beginRegion(State& state, Scratch& scratch, Collection& c, OpenRegion& region) {
  region.slot = static_cast<std::uint32_t>(state.collections.slotOf(c));
  if (!opensInPart(state, c) || wasSearched(c)) return addAll(state, scratch, region);
  addOwn(state, scratch, c, region);
  addUnbalanced(state, scratch, c, region);
  completeMost(state, scratch, c, region);
}

void listRegion(State& state, Scratch& scratch, OpenRegion& region) {
  if (region.members.empty()) return;
  Collection& c = state.collections[region.slot];
  std::ranges::sort(region.members);
  for (const std::uint32_t m : region.members) scratch.open_members.push_back(c.members[m]);
  startMembers(state, scratch, c, region);
  pushFromOutside(state, scratch, c, region);
  for (const std::uint32_t block : blocksAt(c, region.members)) {
    const Weld& weld = c.weldOf(block);
    if (!isInside(scratch, c, weld.node_a) || !isInside(scratch, c, weld.node_b)) continue;
    scratch.open_rows.push_back(RowSource::inside(region.slot, block));
  }
}

bool widen(State& state, Scratch& scratch, OpenRegion& region) {
  Collection& c = state.collections[region.slot];
  std::vector<std::uint32_t> behind;
  forEachHeld(scratch, c, region, [&](const ContactBlock& inner, std::uint32_t, std::uint32_t out) {
    const ContactBlock k = turned(state[c.rigid].rotation, inner);
    const double residual = residualOf(k, k.nx, k.ny, solvedVelocity(state, scratch, BodyId{k.a}),
                                       solvedVelocity(state, scratch, BodyId{k.b}));
    if (residual > slowestCut(state, c, out)) behind.push_back(out);
  });
  const std::size_t first = region.members.size();
  for (const std::uint32_t m : behind) addIfOutside(state, scratch, region, m);
  if (!behind.empty()) addAround(state, scratch, region, first);
  if (!region.whole) {
    for (const std::uint32_t m : findDisturbed(state, scratch, c, region.passes)) {
      addMember(state, scratch, region, m);
    }
  }
  completeMost(state, scratch, c, region);
  return region.members.size() > first;
}

std::vector<std::uint32_t> weldsAt(const Collection& c, std::span<const std::uint32_t> members) {
  IndexSet welds(c.welds.size());
  for (const std::uint32_t m : members) {
    for (const std::uint32_t w : c.welds_of[m]) welds.add(w);
  }
  return welds.ascending();
}

std::vector<std::uint32_t> blocksAt(const Collection& c, std::span<const std::uint32_t> members) {
  IndexSet blocks(c.blocks.size());
  for (const std::uint32_t m : members) {
    for (const std::uint32_t w : c.welds_of[m]) {
      forEachBlock(c, c.welds[w], [&](std::uint32_t block) { blocks.add(block); });
    }
  }
  return blocks.ascending();
}

void restoreImpulses(const State& state, Collection& c, const OpenRegion& region, Witness& sought) {
  if (region.whole) return swapImpulses(c, sought);
  IndexSet ends(c.members.size());
  for (const auto& [block, impulses] : region.before) {
    c.blocks[block].lambda = impulses;
    const Weld& weld = c.weldOf(block);
    for (const std::uint32_t node : {weld.node_a, weld.node_b}) {
      if (!isFrame(c, node)) ends.add(node);
    }
  }
  if (!c.push.of.empty()) renewPush(state, c, ends.ascending());
}

}  // namespace merge2d
