#include "src2d/merging/detours.h"

#include <algorithm>
#include <array>

#include "src2d/core/memory.h"
#include "src2d/merging/grip.h"
#include "src2d/merging/rule.h"

namespace merge2d {
namespace {

/// Grows a rigid group from one body of a weld until it contains the other one: a body belongs to
/// it when a firm weld joins it, or two contacts in different places do.
class DetourSearch {
 public:
  DetourSearch(const State& state, const Collection& c)
      : c_(c),
        frame_(static_cast<std::uint32_t>(c.members.size())),
        resolution_(resolutionOf(state, c)),
        by_two_(state.settings.merging.cycles != CycleCriterion::Triangle),
        floors_join_(mergingMethod(state).unites_on_floors) {}

  bool leadsAround(const Weld& weld) {
    const std::uint32_t a = weld.node_a, b = weld.node_b;
    return (a != frame_ && growsTo(a, b)) || (b != frame_ && growsTo(b, a));
  }

 private:
  /// A body that a single contact holds to the group so far.
  struct Hinged {
    std::uint32_t node;
    Vec2 at;
  };

  bool growsTo(std::uint32_t from, std::uint32_t to) {
    group_[0] = from;
    count_ = 1;
    hinged_count_ = 0;
    for (std::size_t head = 0; head < count_; ++head) {
      const std::uint32_t node = group_[head];
      for (std::uint32_t k = c_.weld_at[node]; k < c_.weld_at[node + 1]; ++k) {
        const std::uint32_t number = c_.weld_of[k];
        const Weld& weld = c_.welds[number];
        const std::uint32_t other = weld.node_a == node ? weld.node_b : weld.node_a;
        const bool through_frame = other == frame_ && (to != frame_ || floors_join_);
        if (weld.cut || weld.expected || through_frame || contains(other)) continue;
        if (weld.grip != Grip::Firm && !hingeTwice(other, weld)) continue;
        if (other == to) return true;
        if (count_ == group_.size()) return false;
        group_[count_++] = other;
      }
    }
    return false;
  }

  bool contains(std::uint32_t node) const {
    const auto end = group_.begin() + static_cast<std::ptrdiff_t>(count_);
    return std::find(group_.begin(), end, node) != end;
  }

  /// Notes a contact that holds `node` to the group; true when it is the second one.
  bool hingeTwice(std::uint32_t node, const Weld& weld) {
    if (!by_two_) return false;
    bool twice = false;
    forEachHeld(c_, weld, [&](const InternalPoint& point) {
      const Vec2& at = point.position;
      for (std::size_t i = 0; i < hinged_count_; ++i) {
        twice |= hinged_[i].node == node && (hinged_[i].at - at).norm() > resolution_;
      }
      if (hinged_count_ < hinged_.size()) hinged_[hinged_count_++] = {node, at};
    });
    return twice;
  }

  static constexpr std::size_t kMost = 48;  ///< few detours look at more bodies

  const Collection& c_;
  std::uint32_t frame_;  ///< its node
  double resolution_;
  bool by_two_;       ///< two contacts with different bodies of a rigid group hold a body
  bool floors_join_;  ///< which body of the frame holds a part matters
  std::array<std::uint32_t, kMost> group_{};
  std::array<Hinged, kMost> hinged_{};
  std::size_t count_ = 0, hinged_count_ = 0;
};

/// A member by its place, or the frame.
std::uint32_t nodeOf(const State& state, const Collection& c, BodyId body) {
  return state[body].rigid == c.rigid ? state[rigidOf(body)].member
                                      : static_cast<std::uint32_t>(c.members.size());
}

}  // namespace

void indexWelds(const State& state, Collection& c) {
  c.weld_at.assign(c.members.size() + 2, 0);
  for (Weld& weld : c.welds) {
    weld.node_a = nodeOf(state, c, weld.a);
    weld.node_b = nodeOf(state, c, weld.b);
    ++c.weld_at[weld.node_a + 1];
    ++c.weld_at[weld.node_b + 1];
  }
  for (std::size_t n = 1; n < c.weld_at.size(); ++n) c.weld_at[n] += c.weld_at[n - 1];
  reserveTightly(c.weld_of, c.weld_at.back());
  c.weld_of.resize(c.weld_at.back());
  thread_local std::vector<std::uint32_t> next;  // its memory is kept
  next.assign(c.weld_at.begin(), c.weld_at.end() - 1);
  for (std::uint32_t w = 0; w < c.welds.size(); ++w) {
    c.weld_of[next[c.welds[w].node_a]++] = w;
    c.weld_of[next[c.welds[w].node_b]++] = w;
  }
}

bool heldByDetours(const State& state, const Collection& c, std::span<const std::uint32_t> welds) {
  DetourSearch search(state, c);
  return std::ranges::all_of(welds,
                             [&](std::uint32_t weld) { return search.leadsAround(c.welds[weld]); });
}

}  // namespace merge2d
