#pragma once
/// The places and gaps of contacts that were predicted ahead in this step (contact/cast.h).

#include <algorithm>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// A gap up to this is a touch, not a prediction [m]; smaller where one of the shapes is small.
double touchingGap(const State& state, const ContactKey& key);

/// The least gap of the points of a contact that has some [m].
inline double smallestGap(const Contact& contact) {
  const auto& points = contact.points;
  return contact.count == 2 ? std::min(points[0].gap, points[1].gap) : points[0].gap;
}

/// Where a contact was cast to in this step, or nullptr.
const Cast* castOf(const Scratch& scratch, const Contact& contact);

/// The same for a point of it.
const CastEnd* castOf(const Scratch& scratch, const Contact& contact, const ContactPoint& point);

/// Where the surface of the first body is at a point of a contact, in its frame.
Vec2 surfaceOfA(const Scratch& scratch, const Contact& contact, const ContactPoint& point);

/// The same of the second body, in its frame.
Vec2 surfaceOfB(const Scratch& scratch, const Contact& contact, const ContactPoint& point,
                const Pose& b_in_a);

}  // namespace merge2d
