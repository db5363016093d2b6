#pragma once
/// The tests of a step, as plain data: each number with its threshold and its verdict.

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "src2d/core/ids.h"
#include "src2d/core/vec.h"

namespace merge2d {

/// The source of a criterion that is not the paper's: a page, and its section.
inline constexpr std::string_view kOwnMerging = "docs/decisions/cures.md#when-to-merge",
                                  kOwnSleeping = "docs/decisions/cures.md#when-to-sleep",
                                  kOwnDecided = "docs/decisions/decided.md#decision",
                                  kOwnHits = "docs/decisions/hits.md#decision",
                                  kOwnCycles = "docs/cycles.md";

/// One criterion, asked once: a value. The caller acts on it and records it.
struct Criterion {
  std::string_view criterion{};  ///< "relative-motion", "sliding", "breathing", …
  std::string_view equation{};   ///< "(17)", "Section 5.1", or kOwnMerging and its like
  double value = 0.0;
  double threshold = 0.0;
  bool holds = false;  ///< nothing speaks against merging, staying merged or sleeping
};

/// A criterion that holds where a value is below its threshold.
inline Criterion below(std::string_view criterion, std::string_view equation, double value,
                       double threshold) {
  return {criterion, equation, value, threshold, value < threshold};
}

/// The count beside a criterion. Of most it counts consecutive steps; docs/records.md names the
/// others.
struct TestCount {
  int before = 0;  ///< up to the last step
  int count = 0;   ///< this step included; 0: starts anew
  int needed = 0;  ///< how many it takes
};

/// A criterion that a step asked about a pair, and what followed. The words for it are in
/// docs/records.md.
struct Decision {
  BodyId a{}, b{};           ///< the pair; in SleepAndWake both are the first body of what sleeps
  std::string_view stage{};  ///< as in Algorithm 1: "Merge", "Unmerge", …
  std::string_view criterion{}, equation{};
  double value = 0.0;
  double threshold = 0.0;
  int count = 0, needed = 0;   ///< TestCount
  std::string_view verdict{};  ///< "merge", "wait", "apart", "keep", "unmerge", …
  int before = 0;              ///< TestCount
  Vec2 at = Vec2::Zero();      ///< of tests of one contact: where it is, in the world [m]
  /// Of "cycle": the first body of the group that holds the pair; −1: none.
  std::int32_t group = -1;
  std::int32_t members = -1;  ///< all its bodies: an index of Snapshot::groups
};

/// The record of a criterion.
inline Decision record(const Criterion& test, std::string_view stage, BodyId a, BodyId b,
                       std::string_view verdict, const TestCount& count = {}) {
  return {.a = a,
          .b = b,
          .stage = stage,
          .criterion = test.criterion,
          .equation = test.equation,
          .value = test.value,
          .threshold = test.threshold,
          .count = count.count,
          .needed = count.needed,
          .verdict = verdict,
          .before = count.before};
}

/// True when a step welded a pair, of which these are all tests: it was ready, a group holds it
/// where the cycle criterion was asked, and it is not on two frames.
inline bool endInMerge(const std::vector<Decision>& tests) {
  const auto any = [&](std::string_view criterion, std::string_view verdict) {
    return std::ranges::any_of(tests, [&](const Decision& d) {
      return d.stage == "Merge" && d.verdict == verdict &&
             (criterion.empty() || d.criterion == criterion);
    });
  };
  if (any("frames", "apart")) return false;
  return any("cycle", "merge") || (any("", "merge") && !any("cycle", "wait"));
}

/// The bodies of a rigid group: first those whose contacts make it one, ascending, then those that
/// are welded to them already, ascending.
using Group = std::vector<BodyId>;

}  // namespace merge2d
