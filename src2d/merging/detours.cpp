#include "src2d/merging/detours.h"

#include <algorithm>
#include <array>

#include "src2d/core/memory.h"
#include "src2d/cycles/tolerance.h"

namespace merge2d {
namespace {

/// Breadth first over firm welds.
class DetourSearch {
 public:
  DetourSearch(const State& state, const Collection& c)
      : state_(state), c_(c), resolution_(resolutionOf(state, c)) {}

  bool leadsAround(const Weld& weld) {
    const std::uint32_t frame = static_cast<std::uint32_t>(c_.members.size());
    std::uint32_t from = nodeOf(state_, c_, weld.a), to = nodeOf(state_, c_, weld.b);
    if (from == frame) std::swap(from, to);
    reached_[0] = from;
    count_ = 1;
    for (std::size_t head = 0; head < count_; ++head) {
      for (std::uint32_t k = c_.weld_at[reached_[head]]; k < c_.weld_at[reached_[head] + 1]; ++k) {
        const Weld& next = c_.welds[c_.weld_of[k]];
        const std::uint32_t a = nodeOf(state_, c_, next.a), b = nodeOf(state_, c_, next.b);
        const std::uint32_t node = a == reached_[head] ? b : a;
        if ((node == frame && to != frame) || next.cut || next.expected || reached(node) ||
            !isFirm(c_, next, resolution_)) {
          continue;
        }
        if (node == to) return true;
        if (count_ == reached_.size()) return false;
        reached_[count_++] = node;
      }
    }
    return false;
  }

 private:
  bool reached(std::uint32_t node) const {
    const auto end = reached_.begin() + static_cast<std::ptrdiff_t>(count_);
    return std::find(reached_.begin(), end, node) != end;
  }

  const State& state_;
  const Collection& c_;
  double resolution_;
  std::array<std::uint32_t, 48> reached_{};  ///< nodes; few detours look at more
  std::size_t count_ = 0;
};

}  // namespace

std::uint32_t nodeOf(const State& state, const Collection& c, BodyId body) {
  return state[body].rigid == c.rigid ? state[rigidOf(body)].member
                                      : static_cast<std::uint32_t>(c.members.size());
}

void indexWelds(const State& state, Collection& c) {
  c.weld_at.assign(c.members.size() + 2, 0);
  for (const Weld& weld : c.welds) {
    ++c.weld_at[nodeOf(state, c, weld.a) + 1];
    ++c.weld_at[nodeOf(state, c, weld.b) + 1];
  }
  for (std::size_t n = 1; n < c.weld_at.size(); ++n) c.weld_at[n] += c.weld_at[n - 1];
  reserveTightly(c.weld_of, c.weld_at.back());
  c.weld_of.resize(c.weld_at.back());
  thread_local std::vector<std::uint32_t> next;  // its memory is kept
  next.assign(c.weld_at.begin(), c.weld_at.end() - 1);
  for (std::uint32_t w = 0; w < c.welds.size(); ++w) {
    c.weld_of[next[nodeOf(state, c, c.welds[w].a)]++] = w;
    c.weld_of[next[nodeOf(state, c, c.welds[w].b)]++] = w;
  }
}

bool isFirm(const Collection& c, const Weld& weld, double resolution) {
  if (weld.joints > 1) return true;
  const Vec2* first = nullptr;
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    const InternalContact& inner = c.contacts[i];
    for (std::size_t p = 0; p < static_cast<std::size_t>(inner.count); ++p) {
      if (!inner.points[p].active || inner.points[p].lost) continue;
      const Vec2& at = inner.points[p].position;
      if (first && (at - *first).norm() > resolution) return true;
      if (!first) first = &at;
    }
  }
  return false;
}

double resolutionOf(const State& state, const Collection& c) {
  const Aabb& bounds = state.extent(c.rigid).bounds;
  return kPointTolerance * (bounds.upper - bounds.lower).maxCoeff();
}

bool heldByDetours(const State& state, const Collection& c, std::span<const std::uint32_t> welds) {
  DetourSearch search(state, c);
  return std::ranges::all_of(welds,
                             [&](std::uint32_t weld) { return search.leadsAround(c.welds[weld]); });
}

}  // namespace merge2d
