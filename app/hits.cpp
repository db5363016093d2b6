#include "app/hits.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace merge2d {
namespace {

constexpr double kStill = 0.1;  // of the speed of what hits it

/// Null for a body that was not there yet.
const BodyState* find(const Snapshot& seen, BodyId id) {
  const auto at = std::ranges::lower_bound(seen.bodies, id, {}, &BodyState::id);
  return at != seen.bodies.end() && at->id == id ? &*at : nullptr;
}

Vec2 velocityAt(const BodyState& body, const Vec2& point) {
  return body.v + cross(body.omega, Vec2(point - body.x));
}

/// The change of the velocity at the point by a unit impulse along the normal [1/kg].
double mobility(const BodyState& body, const BodyInfo& info, const ContactView& contact) {
  if (body.pinned || info.motion != Motion::Dynamic) return 0.0;
  const double lever = cross(contact.x - body.x, contact.normal);
  return 1.0 / info.mass + lever * lever / info.inertia;
}

/// The energy that a contact which does not give takes out of the approach: w² / (2 Σ mobility).
double approachEnergy(const BodyState& a, const BodyState& b, const ContactView& contact,
                      const std::vector<BodyInfo>& bodies) {
  const double w = contact.normal.dot(velocityAt(b, contact.x) - velocityAt(a, contact.x));
  const double sum =
      mobility(a, bodies[index(a.id)], contact) + mobility(b, bodies[index(b.id)], contact);
  return w < 0.0 && sum > 0.0 ? 0.5 * w * w / sum : 0.0;
}

}  // namespace

void appendHits(const Snapshot& before, const Snapshot& now, const std::vector<BodyInfo>& bodies,
                std::vector<Hit>& hits) {
  for (const Event& event : now.events) {
    if (event.type != EventType::Impact) continue;
    const BodyState *a = find(before, event.a), *b = find(before, event.b);
    if (a == nullptr || b == nullptr) continue;
    double energy = 0.0;
    for (const ContactView& contact : now.contacts) {
      if (contact.a != event.a || contact.b != event.b) continue;
      energy = std::max(energy, approachEnergy(*a, *b, contact, bodies));
    }
    if (b->v.squaredNorm() > a->v.squaredNorm()) std::swap(a, b);
    hits.push_back({now.time, a->id, b->id, b->v.norm() > kStill * a->v.norm(), energy});
  }
}

std::vector<Hit> outstandingHits(std::vector<Hit> hits, double apart) {
  if (hits.empty()) return {};
  std::ranges::stable_sort(hits, std::ranges::greater(), &Hit::energy);
  const double least = hits.size() <= kMostHits ? 0.0 : kOverMedian * hits[hits.size() / 2].energy;
  std::vector<Hit> strongest;  // and the one that comes after them
  for (const Hit& hit : hits) {
    const auto near = [&](const Hit& other) { return std::abs(hit.time - other.time) < apart; };
    if (std::ranges::none_of(strongest, near)) strongest.push_back(hit);
    if (strongest.size() > kMostHits) break;
  }
  const auto standsOut = [&](std::size_t n) {
    const double next = n < strongest.size() ? strongest[n].energy : 0.0;
    return strongest[n - 1].energy >= std::max(least, kOverNext * next);
  };
  std::size_t n = std::min(kMostHits, strongest.size());
  while (n > 0 && !standsOut(n)) --n;
  strongest.resize(n);
  std::ranges::sort(strongest, {}, &Hit::time);
  return strongest;
}

}  // namespace merge2d
