#pragma once
/// Contact graphs as text, and what the cycle criteria say of them. docs/cycles.md explains both.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "src2d/cycles/contraction.h"
#include "src2d/cycles/pins.h"

namespace merge2d {

struct GraphLimits {
  static constexpr std::size_t kFileBytes = std::size_t{64} << 20u;
  static constexpr int kContacts = 1'000'000;  ///< of one pair
  static constexpr double kCoordinate = 1e12;  ///< [m]
};

/// Two bodies in contact.
struct GraphPair {
  std::uint32_t a = 0, b = 0;
  int contacts = 0;          ///< active ones
  std::vector<Vec2> points;  ///< one per contact, or none: not known
};

struct ContactGraph {
  std::vector<std::string> bodies;    ///< names, in the order in which the file mentions them
  std::vector<std::uint8_t> pinned;   ///< per body
  std::vector<GraphPair> pairs;       ///< in the order of the file
  std::vector<std::string> warnings;  ///< sentences with their place
};

/// Reads `pinned A B …` and one line `A B n [x,y …]` per pair; `#` begins a comment. Throws
/// InputError `source:line:column: …`.
ContactGraph parseContactGraph(std::string_view text, const std::string& source);

/// The verdicts of the criteria. Pinned bodies act as one.
struct CycleVerdicts {
  Groups triangle, rigid;            ///< per body
  Groups generic;                    ///< rigid, were the points in general position
  std::vector<CycleOfThree> cycles;  ///< indices of pairs that closed cycles of three
  std::vector<std::uint8_t> pair_triangle, pair_rigid;  ///< per pair: may it merge?
};
CycleVerdicts judge(const ContactGraph& graph);

/// The members of all groups of two or more, ascending, in the order of their first.
std::vector<std::vector<std::uint32_t>> membersOf(const Groups& groups);

}  // namespace merge2d
