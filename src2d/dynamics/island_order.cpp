#include "src2d/dynamics/island_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>

#include "src2d/core/memory.h"
#include "src2d/dynamics/joint_rows.h"
#include "src2d/dynamics/row_sources.h"

namespace merge2d {
namespace {

/// Takes back the notes of the last step about the bodies of its islands, and about no others.
void clearMarks(Scratch& scratch) {
  const auto clear = [&](std::uint32_t r) {
    if (r < scratch.colours.size()) scratch.colours[r] = 0;
    if (r < scratch.island_of.size()) scratch.island_of[r] = -1;
  };
  for (const Island& island : scratch.islands) clear(island.root);
  for (const std::uint32_t r : scratch.island_bodies) clear(r);
}

/// Sorts the blocks by island, then by colour, then by source, in which order they come. Of many
/// blocks each pass counts, and keeps the order of the one before; for few that costs more than to
/// compare them.
void sortBlocks(Scratch& scratch) {
  constexpr std::size_t kFew = 16;
  auto& order = scratch.block_order;
  if (order.size() <= kFew) {
    std::ranges::sort(order);
    return;
  }
  auto& by_colour = scratch.by_colour;
  std::array<std::uint32_t, 65> place{};  // of the next block of each colour
  for (const BlockOrder& block : order) ++place[block.colour() + 1];
  std::partial_sum(place.begin(), place.end(), place.begin());
  by_colour.resize(order.size());
  for (const BlockOrder& block : order) by_colour[place[block.colour()]++] = block;

  auto& next = scratch.island_of;  // per root: first how many blocks, then where the next one goes
  auto& roots = scratch.island_roots;
  roots.clear();
  for (const BlockOrder& block : order) {
    if (next[block.island()] < 0) roots.push_back(block.island());
    next[block.island()] = std::max(next[block.island()], 0) + 1;
  }
  std::ranges::sort(roots);
  std::int32_t first = 0;
  for (const std::uint32_t root : roots) first += std::exchange(next[root], first);
  for (const BlockOrder& block : by_colour) {
    order[static_cast<std::size_t>(next[block.island()]++)] = block;
  }
}

/// True for a rigid thing, or a member of an open collection, that forces move.
bool respondsInSolve(const Scratch& scratch, RigidId id) {
  return scratch.u[index(id)].inv_mass > 0.0;
}

/// Rigid things that move and touch, or hang together by joints, are of one island.
void uniteIslands(const State& state, Scratch& scratch) {
  auto& sets = scratch.sets;
  sets.reset(state.rigids.size());
  for (const RowSource& source : scratch.row_sources) {
    const auto [a, b] = endsOf(state, scratch, source);
    if (respondsInSolve(scratch, a) && respondsInSolve(scratch, b)) {
      sets.unite(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
    }
  }
  uniteJoints(state, scratch);
}

/// Greedy colours, in the order of the pairs.
void colourBlocks(const State& state, Scratch& scratch) {
  resizeTightly(scratch.colours, state.rigids.size());
  resizeTightly(scratch.island_of, state.rigids.size(), -1);
  reserveTightly(scratch.block_order, scratch.row_sources.size());
  scratch.block_order.resize(scratch.row_sources.size());
  for (std::uint32_t i = 0; i < scratch.row_sources.size(); ++i) {
    const RowEnds ends = endsOf(state, scratch, scratch.row_sources[i]);
    const bool a_moves = respondsInSolve(scratch, ends.a),
               b_moves = respondsInSolve(scratch, ends.b);
    std::uint64_t &a = scratch.colours[index(ends.a)], &b = scratch.colours[index(ends.b)];
    const std::uint64_t used = (a_moves ? a : 0) | (b_moves ? b : 0);
    const auto free = static_cast<std::uint32_t>(std::countr_one(used));
    const std::uint32_t colour = std::min(free, BlockOrder::kMixed);
    if (a_moves) a |= std::uint64_t{1} << colour;
    if (b_moves) b |= std::uint64_t{1} << colour;
    const auto body = static_cast<std::uint32_t>(a_moves ? ends.a : ends.b);
    scratch.block_order[i] = BlockOrder::of(scratch.sets.find(body), colour, i);
  }
}

/// Visits all that is in an island.
template <class Visit>
void forEachMover(const State& state, const Scratch& scratch, Visit&& visit) {
  const auto ask = [&](std::uint32_t r) {
    if (scratch.u[r].inv_mass != 0.0 && scratch.colours[r] != 0) visit(r);
  };
  for (const RigidId id : state.present) ask(static_cast<std::uint32_t>(id));
  for (const BodyId b : scratch.open_members) ask(static_cast<std::uint32_t>(b));
}

}  // namespace

void orderBlocks(const State& state, Scratch& scratch) {
  clearMarks(scratch);
  if (scratch.row_sources.empty() && state.joints.empty()) {  // all of it flies
    scratch.block_order.clear();
    scratch.joint_order.clear();
    return;
  }
  uniteIslands(state, scratch);
  colourBlocks(state, scratch);
  sortBlocks(scratch);
}

void listIslandBodies(const State& state, Scratch& scratch) {
  if (scratch.islands.empty()) return scratch.island_bodies.clear();
  auto& island_of = scratch.island_of;
  for (std::size_t i = 0; i < scratch.islands.size(); ++i) {
    island_of[scratch.islands[i].root] = static_cast<std::int32_t>(i);
  }
  for (auto& island : scratch.islands) island.first_body = island.last_body = 0;
  forEachMover(state, scratch, [&](std::uint32_t r) {
    island_of[r] = island_of[scratch.sets.find(r)];
    ++scratch.islands[static_cast<std::size_t>(island_of[r])].last_body;
  });
  std::uint32_t begin = 0;
  for (auto& island : scratch.islands) {
    const std::uint32_t count = island.last_body;
    island.first_body = island.last_body = begin;
    begin += count;
  }
  scratch.island_bodies.resize(begin);
  forEachMover(state, scratch, [&](std::uint32_t r) {
    auto& island = scratch.islands[static_cast<std::size_t>(island_of[r])];
    scratch.island_bodies[island.last_body++] = r;
  });
  if (scratch.open_members.empty()) return;
  for (const auto& island : scratch.islands) {  // rigid things, then members: each ascending
    const auto begin_of = scratch.island_bodies.begin() + island.first_body;
    const auto end_of = scratch.island_bodies.begin() + island.last_body;
    std::inplace_merge(begin_of, std::is_sorted_until(begin_of, end_of), end_of);
  }
}

}  // namespace merge2d
