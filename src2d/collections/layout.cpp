#include "src2d/collections/layout.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>

#include "src2d/collections/collection.h"
#include "src2d/collections/collection_method.h"
#include "src2d/collections/joint_sweep.h"
#include "src2d/collections/joint_welds.h"
#include "src2d/collections/weld_list.h"
#include "src2d/core/memory.h"
#include "src2d/core/regrouping.h"
#include "src2d/core/sorted_tail.h"
#include "src2d/proofs/proof_impulses.h"
#include "src2d/proofs/proof_transfer.h"

namespace merge2d {

Aabb memberBounds(const State& state, BodyId b) {
  return placed({state[b].local, state[b].local_rotation}, state.extent(rigidOf(b)).bounds);
}

void gatherMass(State& state, RigidId id) {
  Rigid& r = state[id];
  const Collection& c = state.collection(id);
  // Seen from a member, so that the rounding does not depend on where in the frame they are.
  const Vec2 origin = state[c.members.front()].local;
  r.mass = 0.0;
  Vec2 first = Vec2::Zero();
  Aabb bounds;
  for (const BodyId b : c.members) {
    r.mass += state[b].mass;
    first += state[b].mass * (state[b].local - origin);
    bounds.include(memberBounds(state, b));
  }
  state.extents[r.extent].bounds = bounds;
  const Vec2 center = r.floating() ? Vec2(origin + first / r.mass) : Vec2(Vec2::Zero());
  r.inertia = 0.0;
  for (const BodyId b : c.members) {
    r.inertia += state[b].inertia + state[b].mass * (state[b].local - center).squaredNorm();
  }
  if (r.floating()) {
    r.moveBy(r.rotation * (center - r.center));
    r.center = center;
    r.inv_mass = 1.0 / r.mass;
    r.inv_inertia = 1.0 / r.inertia;
  }
}

void fitBox(State& state, RigidId id) {
  if (!state[id].floating()) {
    Extent& extent = state.extents[state[id].extent];
    extent.box = {{extent.bounds.center(), {}}, 0.5 * extent.bounds.extent()};
    return;
  }
  std::vector<Vec2> points;
  for (const BodyId b : state.collection(id).members) {
    const Body& body = state[b];
    for (const Vec2& corner : state.extent(rigidOf(b)).box.corners()) {
      points.push_back(Pose{body.local, body.local_rotation}.exactly(corner));
    }
  }
  state.extents[state[id].extent].box = tightBox(points);
}

namespace {

/// Contacts of one pair of bodies in a row form a weld, and so do its joints.
void layOutWelds(const State& state, Collection& c) {
  sortWelds(c);
  const std::vector<Weld> old = std::exchange(c.welds, {});
  c.welds.reserve(old.size());
  for (std::uint32_t i = 0; i < c.contacts.size(); ++i) {
    const ContactKey& key = c.contacts[i].key;
    if (c.welds.empty() || c.welds.back().a != key.a || c.welds.back().b != key.b) {
      c.welds.push_back({.a = key.a, .b = key.b, .first = i, .expected = true});
    }
    c.welds.back().expected &= c.contacts[i].since == kExpected;
    c.welds.back().count = i + 1 - c.welds.back().first;
  }
  addJointWelds(state, c);
  const auto nodeOf = [&](BodyId b) {
    const auto frame = static_cast<std::uint32_t>(c.members.size());
    return state[b].rigid == c.rigid ? state[rigidOf(b)].member : frame;
  };
  for (std::uint32_t w = 0; w < c.welds.size(); ++w) {
    Weld& weld = c.welds[w];
    weld.expected &= weld.joints == 0;
    for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) c.contacts[i].weld = w;
    weld.node_a = nodeOf(weld.a);
    weld.node_b = nodeOf(weld.b);
  }
  tighten(c.welds);
  c.laid_out.sorted_welds = static_cast<std::uint32_t>(c.welds.size());
  std::size_t o = 0;
  for (Weld& weld : c.welds) {
    while (o < old.size() && std::pair(old[o].a, old[o].b) < std::pair(weld.a, weld.b)) ++o;
    if (o == old.size()) break;
    if (old[o].a != weld.a || old[o].b != weld.b) continue;
    weld.moving = old[o].moving;
  }
}

}  // namespace

ContactBlock innerBlock(const State& state, const Collection& c, const InternalContact& contact) {
  const auto origin = [&](BodyId b) {
    return state[b].rigid == c.rigid ? state[b].local : Vec2(Vec2::Zero());
  };
  const SolverVelocity ua = memberMasses(state, c, static_cast<std::uint32_t>(contact.key.a));
  const SolverVelocity ub = memberMasses(state, c, static_cast<std::uint32_t>(contact.key.b));
  BlockGeometry g;
  g.normal = contact.normal;
  g.count = contact.count;
  const InnerRows rows = collectionMethod(state).innerRows(state, contact, ua, ub);
  g.softness = rows.softness;
  for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i) {
    g.arm_a[i] = contact.points[i].position - origin(contact.key.a);
    g.arm_b[i] = contact.points[i].position - origin(contact.key.b);
  }
  ContactBlock k;
  k.a = static_cast<std::uint32_t>(contact.key.a);
  k.b = static_cast<std::uint32_t>(contact.key.b);
  k.mu = frictionOf(state, contact.key.a, contact.key.b);
  k.bilateral = isBilateral(state, contact.key.a, contact.key.b);
  for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i) {
    k.lambda[i] = contact.points[i].lambda_n;
    k.lambda[i + 2] = contact.points[i].lambda_t;
    k.bias[i] = rows.bias[i];
  }
  if (contact.count == 1) {
    k.setRolling(rollingOf(state, contact.key.a, contact.key.b), contact.points[1].lambda_t);
  }
  prepareBlock(k, g, ua, ub);
  return k;
}

namespace {

/// The order of an undisturbed sweep: active contacts first, by colour, so that blocks in a row
/// share no body and need not wait for each other. Returns per block its place before.
Regrouping orderBlocks(Collection& c) {
  constexpr std::uint32_t kColours = 64;
  std::vector<std::uint32_t> colour_of;  // dormant contacts follow after all others
  colour_of.reserve(c.contacts.size());
  std::array<std::uint32_t, 2 * kColours + 1> first{};
  std::vector<std::uint64_t> used(c.members.size(), 0);
  const auto colours = [&](std::uint32_t node) -> std::uint64_t* {
    return node < used.size() ? &used[node] : nullptr;  // the frame's bodies wait for nothing
  };
  for (std::uint32_t i = 0; i < c.contacts.size(); ++i) {
    const InternalContact& inner = c.contacts[i];
    const Weld& weld = c.welds[inner.weld];
    std::uint64_t *a = colours(weld.node_a), *b = colours(weld.node_b);
    const std::uint64_t taken = (a ? *a : 0) | (b ? *b : 0);
    const auto colour = std::min(static_cast<std::uint32_t>(std::countr_one(taken)), kColours - 1);
    if (a) *a |= std::uint64_t{1} << colour;
    if (b) *b |= std::uint64_t{1} << colour;
    const bool dormant = !inner.watch[0].active && !inner.watch[1].active;
    colour_of.push_back(colour + (dormant ? kColours : 0));
    ++first[colour_of.back() + 1];
  }
  c.laid_out.active_blocks = std::accumulate(first.begin(), first.begin() + kColours + 1, 0u);
  std::partial_sum(first.begin(), first.end(), first.begin());
  reserveTightly(c.block_contact, colour_of.size());
  c.block_contact.resize(colour_of.size());
  std::vector<std::uint32_t> from(colour_of.size());
  for (std::uint32_t i = 0; i < colour_of.size(); ++i) {
    const std::uint32_t place = first[colour_of[i]]++;
    c.block_contact[place] = i;
    from[place] = std::exchange(c.contacts[i].block, place);
  }
  return Regrouping(std::move(from));
}

/// Blocks that still fit move to their new places; the others are made.
void layOutBlocks(const State& state, Collection& c) {
  static_assert(InternalContact::kNoBlock == Regrouping::kNew);
  const Regrouping regrouping = orderBlocks(c);
  reserveTightly(c.blocks, c.block_contact.size());
  regrouping.apply(c.blocks);
  tighten(c.blocks);
  c.laid_out.points = 0;
  for (InternalContact& inner : c.contacts) {
    if (regrouping.from()[inner.block] == Regrouping::kNew) {
      ContactBlock& k = c.blocks[inner.block];
      k = innerBlock(state, c, inner);
      inner.count = static_cast<std::int16_t>(k.count);  // points too close to each other are one
    }
    c.laid_out.points += inner.count;
  }
}

}  // namespace

void putBlocksAway(Collection& c) {
  for (InternalContact& inner : c.contacts) dropBlock(c, inner);
  std::vector<ContactBlock>().swap(c.blocks);
  c.push = {};
  c.welds_of = {};
}

void bringBlocksBack(const State& state, Collection& c) {
  if (!areBlocksAway(c)) return;
  reserveTightly(c.blocks, c.block_contact.size());
  for (const std::uint32_t contact : c.block_contact) {
    c.contacts[contact].block = static_cast<std::uint32_t>(c.blocks.size());
    c.blocks.push_back(innerBlock(state, c, c.contacts[contact]));
  }
}

void listWeldsOfMembers(Collection& c) {
  if (!c.welds_of.empty()) return;
  const auto frame = static_cast<std::uint32_t>(c.members.size());
  c.welds_of.build(c.members.size(), [&](auto&& visit) {
    for (std::uint32_t w = 0; w < c.welds.size(); ++w) {
      for (const std::uint32_t node : {c.welds[w].node_a, c.welds[w].node_b}) {
        if (node != frame) visit(node, w);
      }
    }
  });
}

namespace {

void layOutAnew(State& state, Collection& c) {
  sortTail(c.members);
  sortTail(c.contacts, [](const auto& x, const auto& y) { return x.key < y.key; });
  ProofTransfer proofs(state, c);
  proofs.noteBlocks();
  tighten(c.contacts);
  tighten(c.members);
  for (std::uint32_t i = 0; i < c.members.size(); ++i) state[rigidOf(c.members[i])].member = i;
  c.laid_out.members = static_cast<std::uint32_t>(c.members.size());
  if (!state[c.rigid].floating()) gatherMass(state, c.rigid);
  fitBox(state, c.rigid);
  layOutWelds(state, c);
  layOutBlocks(state, c);
  proofs.finish();
  c.push.forget();  // made for whoever needs it next
  c.welds_of = {};
}

void layOut(State& state, Collection& c) {
  if (!c.certificate.empty()) bringBlocksBack(state, c), writeImpulses(c);
  layOutJoints(state, c);
  if (!layOutGrowth(state, c)) layOutAnew(state, c);
  c.stale = false;
  c.settled = false;
}

}  // namespace

void layOutCollections(State& state) {
  for (Collection& c : state.collections) {
    if (c.id != kNoCollection && c.stale) layOut(state, c);
  }
}

void layOutFloating(State& state) {
  for (Collection& c : state.collections) {
    if (c.id == kNoCollection || !c.stale) continue;
    if (state[c.rigid].floating() || !c.certificate.empty()) layOut(state, c);
  }
}

}  // namespace merge2d
