#pragma once
/// Which joints a body has, and which joints the stages go through.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "src2d/core/ids.h"
#include "src2d/core/memory.h"
#include "src2d/dynamics/parked.h"

namespace merge2d {

/// Per body the joints that it ever had, the newest first.
class JointsOfBodies {
 public:
  bool empty() const { return next_.empty(); }
  std::size_t memoryBytes() const { return bytesOf(heads_, next_); }

  /// `joint` is one more than the last one; without `b` it holds `a` to the world.
  void add(std::uint32_t joint, BodyId a, std::optional<BodyId> b) {
    next_.resize(2 * (std::size_t{joint} + 1), kNone);
    link(2 * joint, a);
    if (b) link(2 * joint + 1, *b);
  }

  /// Calls `visit(joint)` for each of a body's, broken ones too.
  template <class Visit>
  void forEach(BodyId body, Visit&& visit) const {
    if (index(body) >= heads_.size()) return;
    for (std::uint32_t half = heads_[index(body)]; half != kNone; half = next_[half]) {
      visit(half / 2);
    }
  }

 private:
  /// Half 2i + k is that of end k of joint i.
  void link(std::uint32_t half, BodyId body) {
    if (heads_.size() <= index(body)) heads_.resize(index(body) + 1, kNone);
    next_[half] = heads_[index(body)];
    heads_[index(body)] = half;
  }

  std::vector<std::uint32_t> heads_;  ///< per body: its first half
  std::vector<std::uint32_t> next_;   ///< per half
};

/// Joints by their index in State::joints.
struct JointLists {
  JointsOfBodies of_body;
  std::vector<std::uint32_t> present;  ///< neither broken nor parked; ascending
  ParkedPairs<std::uint32_t> parked;   ///< of which all that is held is parked, or never moves
};

}  // namespace merge2d
