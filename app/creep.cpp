#include "app/creep.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace merge2d {
namespace {

/// Nothing is heavier than what does not respond to forces.
double weight(const BodyInfo& body) {
  return body.motion == Motion::Dynamic ? body.mass : std::numeric_limits<double>::infinity();
}

using Touching = std::pair<BodyId, BodyId>;

/// The pairs between which a force acts, ascending.
std::vector<Touching> touching(const Snapshot& now) {
  std::vector<Touching> out;
  for (const ContactView& contact : now.contacts) {
    if (contact.state == ContactState::Broken) continue;
    const Touching pair(contact.a, contact.b);
    if (out.empty() || out.back() != pair) out.push_back(pair);
  }
  return out;
}

const BodyState& stateOf(const Snapshot& now, BodyId id) {
  return *std::ranges::lower_bound(now.bodies, id, {}, &BodyState::id);
}

Vec2 seenFrom(const Snapshot& now, BodyId frame, BodyId body) {
  return stateOf(now, frame).pose().toLocal(stateOf(now, body).x);
}

}  // namespace

void CreepMeter::begin(const Snapshot& now, const std::vector<BodyInfo>& bodies) {
  pairs_.clear();
  for (const auto& [a, b] : touching(now)) {
    Pair pair{.a = a, .b = b, .frame = a, .body = b};
    if (weight(bodies[index(b)]) > weight(bodies[index(a)])) std::swap(pair.frame, pair.body);
    pair.start = pair.last = seenFrom(now, pair.frame, pair.body);
    pairs_.push_back(pair);
  }
}

void CreepMeter::update(const Snapshot& now) {
  for (Pair& pair : pairs_) {
    pair.last = seenFrom(now, pair.frame, pair.body);
    pair.farthest = std::max(pair.farthest, (pair.last - pair.start).norm());
  }
}

Creep CreepMeter::result(const Snapshot& now) const {
  const std::vector<Touching> still = touching(now);
  Creep creep;
  for (const Pair& pair : pairs_) {
    if (!std::ranges::binary_search(still, Touching(pair.a, pair.b))) continue;
    const double way = (pair.last - pair.start).norm();
    creep.mean += way;
    creep.largest = std::max(creep.largest, way);
    creep.largest_ever = std::max(creep.largest_ever, pair.farthest);
    ++creep.pairs;
  }
  if (creep.pairs > 0) creep.mean /= creep.pairs;
  return creep;
}

}  // namespace merge2d
