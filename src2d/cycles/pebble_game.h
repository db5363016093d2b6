#pragma once
/// Which bodies a set of pins holds together, when the pins are in general position.
///
/// Tay's theorem for bodies and pins in the plane: n bodies are rigid exactly when their graph,
/// with each pin doubled (it removes two of the three relative freedoms of its bodies), contains
/// three spanning trees without a common edge; in other words, when 3(n − 1) of the doubled edges
/// are independent in the matroid of (3, 3)-sparsity: no n' bodies carry more than 3(n' − 1) of
/// them. The maximal rigid groups have no body in common.
///
/// Sources: Tay, "Linking (n − 2)-dimensional panels in n-space" (1989); Whiteley, "The union of
/// matroids and the rigidity of frameworks" (1988); Lee and Streinu, "Pebble game algorithms and
/// sparse graphs" (2008).

#include <array>
#include <optional>
#include <span>

#include "src2d/cycles/pins.h"

namespace merge2d {

/// The (3, 3) pebble game. Each node owns three pebbles: its freedoms in the plane. Each
/// independent edge is covered by a pebble of one of its nodes, and points from there to the other.
/// Nodes found to be rigid together are contracted into one, which again has three pebbles.
class PebbleGame {
 public:
  explicit PebbleGame(std::uint32_t nodes);

  /// Adds a pin: two edges.
  void pin(std::uint32_t a, std::uint32_t b);

  /// Contracts `a` and `b` when they are in one rigid group by the pins so far. True when they are.
  bool join(std::uint32_t a, std::uint32_t b);

  /// A node of the contracted graph.
  std::uint32_t find(std::uint32_t node);

 private:
  static constexpr int kPebbles = 3;   ///< k of (k, l)-sparsity
  static constexpr int kRequired = 4;  ///< l + 1: an edge is independent when so many can be drawn
  static constexpr std::uint32_t kFree = ~0u;

  /// Where a search came from: the edge in slot `slot` of `node`.
  struct Step {
    std::uint32_t node = 0;
    std::uint32_t slot = 0;
  };

  int freePebbles(std::uint32_t node) const;
  std::optional<std::uint32_t> freeSlot(std::uint32_t node) const;
  bool gather(std::uint32_t a, std::uint32_t b);
  bool draw(std::uint32_t node, std::uint32_t held);
  void turnEdges(std::uint32_t from, std::uint32_t to);
  void contract(std::uint32_t a, std::uint32_t b);

  std::vector<std::uint32_t> parent_;
  std::vector<std::array<std::uint32_t, kPebbles>> slots_;  ///< target of an edge, or a free pebble
  std::vector<Step> came_from_;
  std::vector<std::uint32_t> seen_;  ///< per node: the last search that saw it
  std::uint32_t search_ = 0;
  std::vector<std::uint32_t> reached_;    ///< by the last search
  std::vector<std::uint32_t> reached_a_;  ///< by a failed search from the first node
};

/// The maximal groups that are rigid when all pins are in general position, wherever they are said
/// to be.
Groups genericGroups(std::uint32_t nodes, std::span<const Pin> pins);

}  // namespace merge2d
