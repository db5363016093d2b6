#pragma once
/// Finding again in one snapshot what was seen in another.

#include <algorithm>
#include <cstdint>
#include <map>
#include <tuple>

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

}  // namespace merge2d
