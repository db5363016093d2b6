#pragma once
/// The parts of a collection that its welds still hold together without those that are cut.

#include <cstdint>
#include <vector>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The frame holds bodies in place but does not join them into one collection.
struct Parts {
  std::vector<std::uint32_t> part;     ///< per member
  std::vector<std::uint8_t> anchored;  ///< per part
};

/// Finds parts: at first each member is one of its own, and floats.
class PartFinder {
 public:
  explicit PartFinder(const Collection& c) : on_frame_(c.members.size(), 0) {
    sets_.reset(c.members.size());
  }

  /// The member that a weld fixes to the frame, or kNone.
  std::uint32_t fixedBy(const Weld& weld) const;
  void join(const Weld& weld);
  void unite(std::uint32_t a, std::uint32_t b) { sets_.unite(a, b); }
  bool isFixed(std::uint32_t member) const { return on_frame_[member] != 0; }

  /// The parts in the order of their first members.
  Parts parts();

 private:
  DisjointSets sets_;
  std::vector<std::uint8_t> on_frame_;  ///< per member: a weld fixes it there
};

/// Contacts of a weld that have carried a force and have not opened since, and the contacts that
/// its joints count as.
int activeContacts(const Collection& c, const Weld& weld);

/// The components of the graph of welds that are not cut: in a converged solution each body that
/// does not move is held, and no rigidity need be asked for.
Parts componentsOf(const Collection& c);

bool fallsApart(const State& state, const Collection& c, const Parts& parts);

}  // namespace merge2d
