#include "src2d/merging/spare_welds.h"

#include <algorithm>

#include "src2d/merging/detours.h"
#include "src2d/merging/grip.h"

namespace merge2d {
namespace {

void sortUnique(std::vector<std::uint32_t>& welds) {
  std::ranges::sort(welds);
  welds.erase(std::unique(welds.begin(), welds.end()), welds.end());
}

void spare(Collection& c, const std::vector<std::uint32_t>& welds) {
  c.judged = true;
  c.spare.assign(welds.begin(), welds.end());
  c.loosened.clear();
}

bool heldAround(const State& state, const Collection& c, const std::vector<std::uint32_t>& others) {
  const std::size_t few = 4 + c.members.size() / 64;  // more take longer than to judge all
  return others.size() <= few && heldByDetours(state, c, others);
}

/// Whether to find all spare welds for good. A detour holds for this step only; in a calm
/// collection the same contacts are at their limits for long.
bool asksForGood(const State& state, const Scratch& scratch, const Collection& c) {
  constexpr std::int64_t kEvery = 16;  // steps
  return state.step % kEvery == 0 && !scratch.disturbed[index(c.rigid) - state.bodies.size()];
}

/// Whether the collection would hold together without the others and the known spare welds, all at
/// once: then none of them is asked about for a while.
bool othersAreSpare(const State& state, Scratch& scratch, Collection& c,
                    std::vector<std::uint32_t>& others) {
  if (c.spare.empty()) return false;
  others.insert(others.end(), c.spare.begin(), c.spare.end());
  sortUnique(others);
  for (const std::uint32_t weld : others) c.welds[weld].cut = true;
  const bool apart = fallsApart(state, c, judge(state, scratch, c));
  for (const std::uint32_t weld : others) c.welds[weld].cut = false;
  for (const std::uint32_t weld : c.cut_welds) c.welds[weld].cut = true;
  if (!apart) spare(c, others);
  return !apart;
}

}  // namespace

Parts judge(const State& state, Scratch& scratch, const Collection& c) {
  if (scratch.notes) scratch.notes->judged += static_cast<int>(c.welds.size());
  return partsWithoutCuts(state, c);
}

void listOthers(const State& state, Scratch& scratch, const Collection& c) {
  auto& others = scratch.others;
  others.clear();
  const bool stood = !c.stood.empty() && c.stood == c.cut_welds;
  if (stood && !asksForGood(state, scratch, c)) return;
  for (const auto* welds : {&c.cut_welds, &c.loosened}) {
    for (const std::uint32_t weld : *welds) {
      if (!std::ranges::binary_search(c.spare, weld)) others.push_back(weld);
    }
  }
  sortUnique(others);
}

bool losesAMember(const Collection& c, const Scratch& scratch) {
  const auto holdsNothing = [&](std::uint32_t node) {
    if (node == c.members.size()) return false;  // the frame
    return std::none_of(c.weld_of.begin() + c.weld_at[node],
                        c.weld_of.begin() + c.weld_at[node + 1], [&](std::uint32_t weld) {
                          return !c.welds[weld].cut && !c.welds[weld].expected &&
                                 holds(c.welds[weld].grip);
                        });
  };
  return std::ranges::any_of(scratch.others, [&](std::uint32_t weld) {
    if (!c.welds[weld].cut) return false;
    return holdsNothing(c.welds[weld].node_a) || holdsNothing(c.welds[weld].node_b);
  });
}

std::optional<Parts> partsAtCuts(const State& state, Scratch& scratch, Collection& c, bool anew) {
  auto& others = scratch.others;
  if (others.empty() && !anew) return {};
  // After a layout nobody has asked yet whether the collection holds together.
  const bool known = c.judged && !anew, for_good = asksForGood(state, scratch, c);
  if (known && !for_good && heldAround(state, c, others)) {
    c.stood.assign(c.cut_welds.begin(), c.cut_welds.end());
    return {};
  }
  if (known && for_good && othersAreSpare(state, scratch, c, others)) return {};
  // Welds without a detour mostly part, spare ones or not.
  Parts parts = judge(state, scratch, c);
  if (fallsApart(state, c, parts)) return parts;
  if (known && !for_good && othersAreSpare(state, scratch, c, others)) return {};
  others.assign(c.cut_welds.begin(), c.cut_welds.end());
  sortUnique(others);
  spare(c, others);
  return {};
}

}  // namespace merge2d
