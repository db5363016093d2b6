#include "src2d/merging/grip.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src2d/core/memory.h"
#include "src2d/cycles/tolerance.h"

namespace merge2d {
namespace {

bool hadContact(const Collection& c, const Weld& weld) {
  if (weld.joints > 0) return true;
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    if (c.contacts[i].watch[0].active || c.contacts[i].watch[1].active) return true;
  }
  return false;
}

bool isFirm(const Collection& c, const Weld& weld, double resolution) {
  if (weld.joints > 1) return true;
  const Vec2* first = nullptr;
  bool firm = false;
  forEachHeld(c, weld, [&](const InternalPoint& point) {
    firm |= first && (point.position - *first).norm() > resolution;
    if (!first) first = &point.position;
  });
  return firm;
}

Grip gripOf(const Collection& c, const Weld& weld, double resolution) {
  if (isFirm(c, weld, resolution)) return Grip::Firm;
  const int held = activeContacts(c, weld);
  if (held > 0) return held > 1 ? Grip::Several : Grip::Pivot;
  return hadContact(c, weld) ? Grip::Lost : Grip::None;
}

/// A weld as a pivot; of one to the frame the reach is not known.
Pivot pivotAt(const State& state, const Collection& c, std::uint32_t weld) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Body &a = state[c.welds[weld].a], &b = state[c.welds[weld].b];
  if (a.rigid != c.rigid || b.rigid != c.rigid) return {weld, kInfinity};
  const auto size = [](const Vec2& v) { return v.lpNorm<1>(); };  // needs no root
  double radius = 0.0;
  for (const BodyId id : {c.welds[weld].a, c.welds[weld].b}) {
    const OrientedBox& box = state.extent(rigidOf(id)).box;
    radius = std::max(radius, size(box.frame.position) + size(box.half));
  }
  const auto reach = static_cast<float>(radius + size(b.local - a.local));
  return {weld, std::nextafter(reach, kInfinity)};
}

/// A weld that has just become a pivot joins the others, one that has ceased to be one leaves them.
void keepPivots(const State& state, Collection& c, std::uint32_t weld) {
  if (c.pivots_stale) return;
  const auto place = std::ranges::lower_bound(c.pivots, weld, {}, &Pivot::weld);
  if (!isPivot(c.welds[weld].grip)) {
    c.pivots.erase(place);
    return;
  }
  const auto offset = place - c.pivots.begin();
  reserveTightly(c.pivots, c.pivots.size() + 1);
  c.pivots.insert(c.pivots.begin() + offset, pivotAt(state, c, weld));
}

}  // namespace

int activeContacts(const Collection& c, const Weld& weld) {
  int active = weld.joints;
  forEachHeld(c, weld, [&](const InternalPoint&) { ++active; });
  return active;
}

double resolutionOf(const State& state, const Collection& c) {
  const Aabb& bounds = state.extent(c.rigid).bounds;
  return kPointTolerance * (bounds.upper - bounds.lower).maxCoeff();
}

void updateGrip(const State& state, Collection& c, std::uint32_t weld) {
  Grip& grip = c.welds[weld].grip;
  const bool turned = isPivot(grip);
  grip = gripOf(c, c.welds[weld], resolutionOf(state, c));
  if (!isPivot(grip)) c.welds[weld].turning = {};
  if (isPivot(grip) != turned) keepPivots(state, c, weld);
}

void findGrips(const State& state, Collection& c) {
  c.pivots_stale = true;
  const double resolution = resolutionOf(state, c);
  for (std::uint32_t i = 0; i < c.welds.size(); ++i) {
    if (c.welds[i].grip == Grip::Unknown) c.welds[i].grip = gripOf(c, c.welds[i], resolution);
    if (!isPivot(c.welds[i].grip)) c.welds[i].turning = {};
  }
}

void listPivots(const State& state, Collection& c) {
  const auto turns = [](const Weld& weld) { return isPivot(weld.grip); };
  c.pivots.clear();
  c.pivots_stale = false;
  reserveTightly(c.pivots, static_cast<std::size_t>(std::ranges::count_if(c.welds, turns)));
  for (std::uint32_t i = 0; i < c.welds.size(); ++i) {
    if (turns(c.welds[i])) c.pivots.push_back(pivotAt(state, c, i));
  }
}

}  // namespace merge2d
