#include "src2d/cycles/pebble_game.h"

#include <algorithm>
#include <numeric>

namespace merge2d {

PebbleGame::PebbleGame(std::uint32_t nodes)
    : parent_(nodes), slots_(nodes), came_from_(nodes), seen_(nodes, 0) {
  std::iota(parent_.begin(), parent_.end(), 0u);
  for (auto& slots : slots_) slots.fill(kFree);
}

std::uint32_t PebbleGame::find(std::uint32_t i) {
  while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
  return i;
}

int PebbleGame::freePebbles(std::uint32_t node) const {
  return static_cast<int>(std::count(slots_[node].begin(), slots_[node].end(), kFree));
}

std::optional<std::uint32_t> PebbleGame::freeSlot(std::uint32_t node) const {
  const auto at = std::find(slots_[node].begin(), slots_[node].end(), kFree);
  if (at == slots_[node].end()) return std::nullopt;
  return static_cast<std::uint32_t>(at - slots_[node].begin());
}

/// Draws pebbles to `a` and `b` until they have four. When that fails, they have three, and what
/// the last two searches reached has no others and no edge that leaves it: it is rigid.
bool PebbleGame::gather(std::uint32_t a, std::uint32_t b) {
  while (freePebbles(a) + freePebbles(b) < kRequired) {
    if (draw(a, b)) continue;
    reached_a_ = reached_;
    if (!draw(b, a)) return false;
  }
  return true;
}

/// Brings a pebble to `node` along a shortest path of edges, not through `held`.
bool PebbleGame::draw(std::uint32_t node, std::uint32_t held) {
  ++search_;
  seen_[node] = seen_[held] = search_;
  reached_.assign(1, node);
  for (std::size_t next = 0; next < reached_.size(); ++next) {
    const std::uint32_t from = reached_[next];
    for (std::uint32_t slot = 0; slot < kPebbles; ++slot) {
      if (slots_[from][slot] == kFree) continue;
      const std::uint32_t to = find(slots_[from][slot]);
      if (seen_[to] == search_) continue;
      seen_[to] = search_;
      came_from_[to] = {from, slot};
      if (freeSlot(to)) {
        turnEdges(node, to);
        return true;
      }
      reached_.push_back(to);
    }
  }
  return false;
}

/// Turns the edges on the path that was found, so that the free pebble at its end comes to its
/// start.
void PebbleGame::turnEdges(std::uint32_t start, std::uint32_t end) {
  std::uint32_t free = *freeSlot(end);
  while (end != start) {
    const Step step = came_from_[end];
    slots_[end][free] = step.node;
    slots_[step.node][step.slot] = kFree;
    end = step.node;
    free = step.slot;
  }
}

void PebbleGame::contract(std::uint32_t a, std::uint32_t b) {
  parent_[b] = a;
  for (const auto* reached : {&reached_a_, &reached_}) {
    for (const std::uint32_t node : *reached) parent_[node] = a;
  }
  slots_[a].fill(kFree);
}

bool PebbleGame::join(std::uint32_t x, std::uint32_t y) {
  const std::uint32_t a = find(x), b = find(y);
  if (a == b) return true;
  if (gather(a, b)) return false;
  contract(a, b);
  return true;
}

void PebbleGame::pin(std::uint32_t x, std::uint32_t y) {
  const std::uint32_t a = find(x), b = find(y);
  for (int edge = 0; edge < 2; ++edge) {
    if (join(a, b)) return;  // the edge would be dependent
    const std::uint32_t from = freeSlot(a) ? a : b, to = from == a ? b : a;
    slots_[from][*freeSlot(from)] = to;
  }
  join(a, b);
}

Groups genericGroups(std::uint32_t nodes, std::span<const Pin> pins) {
  PebbleGame game(nodes);
  for (const Pin& p : pins) game.pin(p.a, p.b);
  // A group that its last pin has made rigid may be larger than what the search reached.
  for (const Pin& p : pins) game.join(p.a, p.b);
  return namedGroups(nodes, [&](std::uint32_t i) { return game.find(i); });
}

}  // namespace merge2d
