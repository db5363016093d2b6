#pragma once
/// Finding again in one snapshot what was seen in another.

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <tuple>

#include "src2d/recorder.h"
#include "src2d/trace/snapshot.h"

namespace merge2d {

using ContactKeyOf = std::tuple<BodyId, BodyId, std::uint32_t>;
inline ContactKeyOf keyOf(const ContactView& c) { return {c.a, c.b, c.feature}; }

inline std::map<ContactKeyOf, const ContactView*> byKey(const Snapshot& s) {
  std::map<ContactKeyOf, const ContactView*> all;
  for (const ContactView& c : s.contacts) all.emplace(keyOf(c), &c);
  return all;
}

/// Null when it is not there.
inline const BodyState* bodyIn(const Snapshot& s, BodyId id) {
  const auto found = std::ranges::lower_bound(s.bodies, id, {}, &BodyState::id);
  return found != s.bodies.end() && found->id == id ? &*found : nullptr;
}

/// How many collections were opened before the solve, for their bodies to be solved one by one.
inline std::size_t openedCollections(const StepRecord& record) {
  std::set<BodyId> first;
  for (const Decision& d : record[Stage::WarmStart].after.decisions) {
    if (d.verdict == "open") first.insert(d.a);
  }
  return first.size();
}

/// Inside how many collections impulses that carry the load of the step were sought.
inline std::size_t searchedCollections(const StepRecord& record) {
  std::set<BodyId> first;
  for (const Decision& d : record[Stage::SingleIterationPGS].after.decisions) {
    if (d.criterion != "neighbour-hit") first.insert(d.a);
  }
  return first.size();
}

}  // namespace merge2d
