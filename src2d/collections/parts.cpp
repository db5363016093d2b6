#include "src2d/collections/parts.h"

namespace merge2d {

std::uint32_t PartFinder::fixedBy(const Weld& weld) const {
  const auto frame = static_cast<std::uint32_t>(on_frame_.size());  // its node is the last
  if (weld.node_a == frame) return weld.node_b;
  return weld.node_b == frame ? weld.node_a : kNone;
}

void PartFinder::join(const Weld& weld) {
  const std::uint32_t fixed = fixedBy(weld);
  if (fixed == kNone) {
    sets_.unite(weld.node_a, weld.node_b);
  } else {
    on_frame_[fixed] = 1;
  }
}

Parts PartFinder::parts() {
  Parts parts;
  std::vector<std::uint32_t> number(on_frame_.size(), kNone);
  for (std::uint32_t m = 0; m < on_frame_.size(); ++m) {
    std::uint32_t& p = number[sets_.find(m)];
    if (p == kNone) {
      p = static_cast<std::uint32_t>(parts.anchored.size());
      parts.anchored.push_back(0);
    }
    parts.part.push_back(p);
    if (isFixed(m)) parts.anchored[p] = 1;
  }
  return parts;
}

int activeContacts(const Collection& c, const Weld& weld) {
  int active = weld.joints;
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    const InternalContact& inner = c.contacts[i];
    for (std::size_t p = 0; p < static_cast<std::size_t>(inner.count); ++p) {
      active += inner.watch[p].holds() ? 1 : 0;
    }
  }
  return active;
}

Parts componentsOf(const Collection& c) {
  PartFinder finder(c);
  for (const Weld& weld : c.welds) {
    if (!weld.cut && !weld.expected) finder.join(weld);
  }
  return finder.parts();
}

bool fallsApart(const State& state, const Collection& c, const Parts& parts) {
  return parts.anchored.size() > 1 || (parts.anchored[0] != 0) != !state[c.rigid].floating();
}

}  // namespace merge2d
