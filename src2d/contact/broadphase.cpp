#include "src2d/contact/broadphase.h"

#include <algorithm>
#include <cmath>

#include "src2d/contact/approach.h"
#include "src2d/contact/table.h"
#include "src2d/core/memory.h"
#include "src2d/dynamics/task_pool.h"

namespace merge2d {
namespace {

/// Shapes are paired while their boxes are nearer than this, and paired anew once the two rigid
/// things have moved by as much against each other [m].
constexpr double kNear = 0.05;

/// Changes of a rigid thing: its box left its leaf's, or it has other members than before.
constexpr std::uint8_t kMoved = 1, kResized = 2;

Aabb worldBounds(const State& state, const Rigid& r) {
  return placed(r.frame(), state.extent(r).bounds);
}

/// Where a rigid thing is, and where it can be until the end of this step. Small turns are left to
/// the room that shapes are given.
Aabb sweptBounds(const State& state, const Rigid& r, const Vec2& way, double by_turning) {
  Aabb now = worldBounds(state, r);
  if (by_turning > kNear) now = now.grown(by_turning);
  Aabb swept = now;
  swept.include(Aabb{now.lower + way, now.upper + way});
  return swept;
}

std::array<Vec2, 4> cornersSeenFrom(const Pose& relative, const Aabb& box) {
  return {relative * box.lower, relative * Vec2(box.upper.x(), box.lower.y()), relative * box.upper,
          relative * Vec2(box.lower.x(), box.upper.y())};
}

bool hasShapeTree(const State& state, RigidId id) {
  return state.broadphase.shape_trees[index(id)] != nullptr;
}

/// The shape of a rigid thing without a tree of shapes: a body (collections always have one).
std::uint32_t onlyShape(const State& state, RigidId id) {
  return state.bodies[index(id)].first_shape;
}

bool moves(const Rigid& r) { return !r.asleep && r.anchor != kWorldFrame; }

/// Pairs of fixed bodies are of no interest, nor is what never moves against each other. Of a
/// collection that is fixed to a frame the members can still be freed.
bool canTouch(const State& state, RigidId ra, RigidId rb) {
  const Rigid &a = state[ra], &b = state[rb];
  if (!moves(a) && !moves(b)) return false;
  if (a.floating() || b.floating()) return true;
  return (state.isCollection(ra) || state.isCollection(rb)) && a.anchor != b.anchor;
}

bool bodiesCollide(const State& state, BodyId a, BodyId b) {
  return a != b && state[a].rigid != state[b].rigid && !joined(state, a, b);
}

ContactKey keyOf(const State& state, std::uint32_t shape_a, std::uint32_t shape_b) {
  BodyId a = state.shape_body[shape_a], b = state.shape_body[shape_b];
  if (b < a) {
    std::swap(a, b);
    std::swap(shape_a, shape_b);
  }
  return {a, b, shape_a, shape_b};
}

Pose shapeFrame(const State& state, RigidId id, std::uint32_t shape) {
  const Body& body = state[state.shape_body[shape]];
  return state.isCollection(id) ? Pose{body.local, body.local_rotation} : Pose{};
}

Aabb shapeBounds(const State& state, RigidId id, std::uint32_t shape) {
  return placed(shapeFrame(state, id, shape), state.bounds(shape));
}

/// Follows what moved; fills `moved`.
void moveLeaves(State& state, Scratch& scratch, const Approaches& approaches) {
  resizeTightly(scratch.moved_flag, state.rigids.size());
  for (const RigidId id : scratch.moved) {
    if (index(id) < state.rigids.size()) scratch.moved_flag[index(id)] = 0;
  }
  scratch.moved.clear();
  for (const RigidId id : state.present) {
    Rigid& r = state[id];
    if (!moves(r) && !r.resized) continue;
    const Vec2 way = state.h * startMotion(state, scratch, id).v;
    const Aabb swept = sweptBounds(state, r, way, approaches.byTurning(id));
    const bool left = state.broadphase.tree.move(r.leaf, swept, way);
    if (!left && !r.resized) continue;
    scratch.moved.push_back(id);
    scratch.moved_flag[index(id)] = r.resized ? kResized : kMoved;
    r.resized = false;
  }
  state.broadphase.tree.settle();
}

/// Lists two rigid things that are near each other: as a pair of shapes at once where both have one
/// shape, as a near pair otherwise.
void listNeighbours(const State& state, RigidId a, RigidId b, std::vector<ContactKey>& candidates,
                    std::vector<NearPair>& near) {
  if (!canTouch(state, a, b)) return;
  if (hasShapeTree(state, a) || hasShapeTree(state, b)) {
    NearPair pair{.a = std::min(a, b), .b = std::max(a, b)};
    near.push_back(pair);
  } else if (!joined(state, BodyId{static_cast<std::uint32_t>(a)},
                     BodyId{static_cast<std::uint32_t>(b)})) {
    candidates.push_back(keyOf(state, onlyShape(state, a), onlyShape(state, b)));
  }
}

/// Asks the tree who is near something that moved.
void findNeighboursOf(const State& state, const Scratch& scratch, RigidId id,
                      std::vector<ContactKey>& candidates, std::vector<NearPair>& near) {
  state.broadphase.tree.queryLeaf(state[id].leaf, [&](std::uint32_t other) {
    const RigidId o{other};
    if (o == id || (scratch.moved_flag[other] && o < id)) return;
    listNeighbours(state, id, o, candidates, near);
  });
}

/// Asks the tree for all that are near each other, where that costs less.
void findAllNeighbours(const State& state, Scratch& scratch) {
  state.broadphase.tree.forEachPair([&](std::uint32_t a, std::uint32_t b) {
    if (!scratch.moved_flag[a] && !scratch.moved_flag[b]) return;
    listNeighbours(state, RigidId{a}, RigidId{b}, scratch.candidates, scratch.near_candidates);
  });
}

/// Who is near anything that moved.
void findNeighbours(State& state, Scratch& scratch) {
  constexpr std::size_t kGrain = 128;
  constexpr std::size_t kMany = 4;  // where one of so many moved, all pairs are asked for at once
  scratch.candidates.clear();
  scratch.near_candidates.clear();
  const auto& moved = scratch.moved;
  if (kMany * moved.size() > state.broadphase.tree.size()) {
    return findAllNeighbours(state, scratch);
  }
  if (!scratch.tasks) {
    for (const RigidId id : moved) {
      findNeighboursOf(state, scratch, id, scratch.candidates, scratch.near_candidates);
    }
    return;
  }
  scratch.found.resize(std::max(scratch.found.size(), moved.size() / kGrain + 1));
  forEachIndex(scratch.tasks, moved.size(), kGrain, [&](std::size_t i, int) {
    FoundByTask& found = scratch.found[i / kGrain];
    findNeighboursOf(state, scratch, moved[i], found.candidates, found.near);
  });
  const auto append = [](auto& all, auto& some) {
    all.insert(all.end(), some.begin(), some.end());
    some.clear();
  };
  for (FoundByTask& found : scratch.found) {
    append(scratch.candidates, found.candidates);
    append(scratch.near_candidates, found.near);
  }
}

/// Adds the new near pairs and drops those whose fat boxes no longer meet.
void updateNearPairs(State& state, Scratch& scratch) {
  auto& near = state.broadphase.near;
  std::erase_if(near, [&](const NearPair& p) {
    const Rigid &a = state[p.a], &b = state[p.b];
    return !a.present() || !b.present() ||
           !(hasShapeTree(state, p.a) || hasShapeTree(state, p.b)) ||
           !state.broadphase.tree.overlap(a.leaf, b.leaf);
  });
  auto& found = scratch.near_candidates;
  if (found.empty()) return;
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::erase_if(found, [&](const NearPair& p) {
    const auto known = std::lower_bound(near.begin(), near.end(), p);
    if (known == near.end() || !(*known == p)) return false;
    const auto resized = [&](RigidId id) { return scratch.moved_flag[index(id)] == kResized; };
    known->fresh |= resized(p.a) || resized(p.b);  // new members: pair its shapes anew
    return true;
  });
  const auto middle = static_cast<std::ptrdiff_t>(near.size());
  near.insert(near.end(), found.begin(), found.end());
  std::inplace_merge(near.begin(), near.begin() + middle, near.end());
}

/// Pairs of shapes of `host` (which has a tree) and `guest` that are nearer than kNear, or can be
/// after coming nearer by `ahead` [m].
void pairShapes(State& state, Scratch& scratch, RigidId host, RigidId guest, double ahead) {
  const double reach = 2.0 * kNear + ahead;
  const Pose relative = state[host].frame().toLocal(state[guest].frame());
  const auto& host_tree = *state.broadphase.shape_trees[index(host)];
  const auto add = [&](std::uint32_t shape_host, std::uint32_t shape_guest) {
    if (bodiesCollide(state, state.shape_body[shape_host], state.shape_body[shape_guest])) {
      scratch.candidates.push_back(keyOf(state, shape_host, shape_guest));
    }
  };
  const Aabb all = placed(relative, state.extent(guest).bounds).grown(reach);
  host_tree.query(all, [&](std::uint32_t shape_host) {
    if (!hasShapeTree(state, guest)) return add(shape_host, onlyShape(state, guest));
    const Aabb box = placed(relative.inverse(), shapeBounds(state, host, shape_host)).grown(reach);
    state.broadphase.shape_trees[index(guest)]->query(
        box, [&](std::uint32_t shape_guest) { add(shape_host, shape_guest); });
  });
}

/// The bit of a rigid thing in a set of sixteen, which it shares with others.
std::uint16_t bitOf(RigidId id) { return static_cast<std::uint16_t>(1u << (index(id) % 16)); }

/// How far the corners of a near pair have gone since they were last written down [m].
double wayOf(const NearPair& p, const std::array<Vec2, 4>& corners) {
  double longest = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    longest = std::max(longest, (corners[k] - p.corners[k]).squaredNorm());
  }
  return std::sqrt(longest);
}

/// The distance of a thing's points from the centre of its turns, at most [m].
double reachOf(const State& state, RigidId id) {
  return farthestFrom(state.extent(id).bounds, state[id].center);
}

/// The larger one of a near pair, from which the corners of the other one are seen: those of a long
/// ground would fly about where something small turns on it.
RigidId largerOf(const State& state, const NearPair& p) {
  return reachOf(state, p.a) >= reachOf(state, p.b) ? p.a : p.b;
}

/// How far the corners of a near pair can have gone in the last step, in which no point went
/// farther than State::moved: a turn carries those beyond the larger thing farther [m].
double wayInStep(const State& state, const NearPair& p) {
  const RigidId large = largerOf(state, p);
  double farthest = 0.0;
  for (const Vec2& corner : p.corners) {
    farthest = std::max(farthest, (corner - state[large].center).norm());
  }
  const double times = (farthest + static_cast<double>(p.way)) / reachOf(state, large);
  return (1.0 + std::max(1.0, times)) * state.moved;
}

/// Pairs shapes anew where two rigid things have moved against each other, or will in this step.
/// Most have not: nothing has gone as far since the last look.
void refineNearPairs(State& state, Scratch& scratch, const Approaches& approaches) {
  constexpr double kRounding = 1e-6;  // of a sum in float
  auto& near = state.broadphase.near;
  scratch.near_refined.assign(near.size(), 0);
  if (near.empty()) return;
  resizeTightly(scratch.paired_with, std::max(scratch.paired_with.size(), state.rigids.size()));
  for (const NearPair& p : near) scratch.paired_with[index(p.b)] = 0;
  for (std::size_t i = 0; i < near.size(); ++i) {
    NearPair& p = near[i];
    const bool still = !moves(state[p.a]) && !moves(state[p.b]);
    if (!still && p.way < kNear) p.way += static_cast<float>(wayInStep(state, p));
    if (!p.fresh && approaches.farthest() <= kNear && p.way < (1.0 - kRounding) * kNear) continue;
    if (!p.fresh && !canTouch(state, p.a, p.b)) continue;
    const bool a_hosts = hasShapeTree(state, p.a);
    const RigidId host = a_hosts ? p.a : p.b, guest = a_hosts ? p.b : p.a;
    const RigidId large = largerOf(state, p), small = large == p.a ? p.b : p.a;
    const auto corners = cornersSeenFrom(state[large].frame().toLocal(state[small].frame()),
                                         state.extent(small).bounds);
    const double ahead = approaches.between(p.a, p.b);
    const double way = wayOf(p, corners);
    p.way = static_cast<float>(way);
    if (!p.fresh && ahead <= kNear && way <= kNear) continue;
    p.corners = corners;
    p.way = 0.0F;
    p.fresh = false;
    scratch.near_refined[i] = 1;
    scratch.paired_with[index(p.b)] |= bitOf(p.a);
    pairShapes(state, scratch, host, guest, ahead);
  }
}

/// Whether an ascending list names a key; to be asked in ascending order.
class NamedIn {
 public:
  explicit NamedIn(const std::vector<ContactKey>& keys) : keys_(keys) {}
  bool operator()(const ContactKey& key) {
    while (next_ < keys_.size() && keys_[next_] < key) ++next_;
    return next_ < keys_.size() && keys_[next_] == key;
  }

 private:
  const std::vector<ContactKey>& keys_;
  std::size_t next_ = 0;
};

/// Contacts and idle pairs whose rigid things parted, or that a new pairing of their shapes no
/// longer names.
void dropParted(State& state, Scratch& scratch) {
  if (scratch.moved.empty() && !std::ranges::count(scratch.near_refined, 1)) return;
  const auto& near = state.broadphase.near;
  const auto parted = [&](const ContactKey& key, NamedIn& named) {
    const RigidId ra = state[key.a].rigid, rb = state[key.b].rigid;
    const NearPair wanted{.a = std::min(ra, rb), .b = std::max(ra, rb)};
    const bool moved = scratch.moved_flag[index(ra)] != 0 || scratch.moved_flag[index(rb)] != 0;
    const bool paired =  // or a pair with the same bit
        !near.empty() && (scratch.paired_with[index(wanted.b)] & bitOf(wanted.a)) != 0;
    if (!moved && !paired) return false;
    const Rigid &a = state[ra], &b = state[rb];
    if (!a.present() || !b.present()) return true;
    if (moved && !state.broadphase.tree.overlap(a.leaf, b.leaf)) return true;
    if (!paired) return false;
    const auto pair = std::lower_bound(near.begin(), near.end(), wanted);
    if (pair == near.end() || !(*pair == wanted)) return false;
    if (!scratch.near_refined[static_cast<std::size_t>(pair - near.begin())]) return false;
    return !named(key);
  };
  NamedIn of_contacts(scratch.candidates), of_idle(scratch.candidates);
  dropContacts(state.contacts,
               [&](const Contact& contact) { return parted(contact.key, of_contacts); });
  std::erase_if(state.contacts.idle,
                [&](const IdlePair& pair) { return parted(pair.key, of_idle); });
}

}  // namespace

void insertRigid(State& state, RigidId id) {
  Rigid& r = state[id];
  r.leaf = state.broadphase.tree.insert(worldBounds(state, r), static_cast<std::uint32_t>(id));
  r.resized = true;
  state.present.insert(id);
}

void removeRigid(State& state, RigidId id) {
  state.broadphase.tree.remove(state[id].leaf);
  state[id].leaf = -1;
  state.present.erase(id);
}

void addShapes(State& state, RigidId id, const std::vector<BodyId>& bodies) {
  auto& tree = state.broadphase.shape_trees[index(id)];
  if (!tree) tree = std::make_unique<AabbTree>();
  for (const BodyId b : bodies) {
    const Body& body = state[b];
    for (std::uint32_t s = body.first_shape; s < body.first_shape + body.shape_count; ++s) {
      state.broadphase.shape_leaves[s] = tree->insert(shapeBounds(state, id, s), s);
    }
  }
}

void removeShapes(State& state, RigidId id, const std::vector<BodyId>& bodies) {
  auto& tree = *state.broadphase.shape_trees[index(id)];
  for (const BodyId b : bodies) {
    const Body& body = state[b];
    for (std::uint32_t s = body.first_shape; s < body.first_shape + body.shape_count; ++s) {
      tree.remove(state.broadphase.shape_leaves[s]);
      state.broadphase.shape_leaves[s] = -1;
    }
  }
}

void compactTree(State& state) {
  if (state.broadphase.tree.sparse()) rebuildTree(state);
}

void rebuildTree(State& state) {
  auto& tree = state.broadphase.tree;
  std::vector<Aabb> boxes;
  for (const Rigid& r : state.rigids) {
    if (r.present()) boxes.push_back(tree.fatBox(r.leaf));
  }
  tree.clear();
  auto box = boxes.begin();
  for (std::uint32_t i = 0; i < state.rigids.size(); ++i) {
    Rigid& r = state.rigids[i];
    if (r.present()) r.leaf = tree.insertFat(*box++, i);
  }
}

void dropShapeTree(State& state, RigidId id) { state.broadphase.shape_trees[index(id)].reset(); }

void updateBroadphase(State& state, Scratch& scratch, const Approaches& approaches) {
  moveLeaves(state, scratch, approaches);
  findNeighbours(state, scratch);
  updateNearPairs(state, scratch);
  refineNearPairs(state, scratch, approaches);
  auto& candidates = scratch.candidates;
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  dropParted(state, scratch);
  compactContacts(state.contacts);
  addIdlePairs(state.contacts, candidates);
  releaseMany(candidates);
}

}  // namespace merge2d
